#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands.h"
#include "apps/version.h"
#include "forward/threads.h"

namespace {

// Exit statuses of docs/session-format.md.
constexpr int kBadInput = 2, kDefect = 70;

std::string CommandLine(int argc, char** argv) {
  std::string line;
  for (int i = 0; i < argc; ++i) line += (i == 0 ? "" : " ") + std::string(argv[i]);
  return line;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "luxfit: luminaires, reflectances and their uncertainty from photos of a room and luxmeter readings"};
  app.set_version_flag("--version", luxfit::kVersion);
  app.require_subcommand(1);
  luxfit::CommandOptions options;
  options.command_line = CommandLine(argc, argv);
  int threads = 0;

  const auto add = [&](const std::string& name, const std::string& help, bool session,
                       int (*command)(const luxfit::CommandOptions&)) {
    CLI::App* sub = app.add_subcommand(name, help);
    if (session) {
      sub->add_option("SESSION", options.session, "the session file (TOML)")->required();
      sub->add_option("-o,--out", options.out, "folder for the results; nothing is written outside it")
          ->required();
    } else {
      sub->add_option("OUT", options.out, "folder of an earlier run")->required();
    }
    sub->add_flag("--json", options.json, "print the result as JSON on standard output");
    sub->add_option("--threads", threads, "cores to use (0: all)")->check(CLI::NonNegativeNumber);
    return std::make_pair(sub, command);
  };
  const std::vector<std::pair<CLI::App*, int (*)(const luxfit::CommandOptions&)>> commands = {
      add("run", "everything: register the photos, observe, fit, check against the luxmeter", true,
          luxfit::RunCommand),
      add("register", "a pose for every view, in the scene's frame", true, luxfit::RegisterCommand),
      add("fit", "luminaires and reflectances by inverting the radiosity model", true, luxfit::RunCommand),
      add("check", "measured against predicted luxmeter readings of an earlier run", false,
          luxfit::CheckCommand)};

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : kBadInput;
  }
  const luxfit::ThreadLimit limit(threads);
  try {
    for (const auto& [sub, command] : commands) {
      if (sub->parsed()) return command(options);
    }
  } catch (const std::runtime_error& e) {
    std::fprintf(stderr, "luxfit: %s\n", e.what());
    return kBadInput;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "luxfit: a defect of the program, please report it with the session: %s\n",
                 e.what());
    return kDefect;
  }
  return kDefect;
}
