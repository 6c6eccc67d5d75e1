#include "apps/cli/shell_commands.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "apps/cli/describe.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/suggest.h"
#include "apps/version.h"

namespace luxfit {
namespace {

void Print(const std::string& text) { std::fputs(text.c_str(), stdout); }

int Completion(const CLI::App& app, const std::string& shell) {
  const auto commands = DescribeCommands(app);
  if (shell != "bash" && shell != "zsh")
    throw std::runtime_error("completion: SHELL: " + ExpectedOneOf({"bash", "zsh"}, shell));
  Print(shell == "bash" ? BashCompletion(commands) : ZshCompletion(commands));
  return 0;
}

int Manual(const CLI::App& app, const std::string& name, const std::string& folder) {
  const auto commands = DescribeCommands(app);
  const std::string overview = OverviewManual(commands, app.get_description(), kVersion);
  if (!folder.empty()) {
    WriteText(folder + "/luxfit.1", overview);
    for (const CommandDescription& command : commands)
      WriteText(folder + "/luxfit-" + command.name + ".1", CommandManual(command, kVersion));
    return 0;
  }
  if (name.empty()) {
    Print(overview);
    return 0;
  }
  std::vector<std::string> known;
  for (const CommandDescription& command : commands) {
    known.push_back(command.name);
    if (command.name != name) continue;
    Print(CommandManual(command, kVersion));
    return 0;
  }
  throw std::runtime_error("man: COMMAND: " + ExpectedOneOf(known, name));
}

int Help(const CLI::App& app, const std::string& name) {
  if (name.empty()) {
    // app.help() would be that of the command that was typed, which is this one.
    Print(app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal));
    return 0;
  }
  std::vector<std::string> known;
  for (const CLI::App* const command : app.get_subcommands(nullptr)) known.push_back(command->get_name());
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw std::runtime_error("help: COMMAND: " + ExpectedOneOf(known, name));
  Print(app.get_subcommand(name)->help(app.get_name()));
  return 0;
}

}  // namespace

void AddShellCommands(CLI::App& app, Invocation& invocation) {
  CLI::App* const completion =
      app.add_subcommand("completion", "a completion script for the shell, on standard output");
  const auto shell = std::make_shared<std::string>();
  completion->add_option("SHELL", *shell, "bash | zsh")->required();
  completion->final_callback(
      [&app, &invocation, shell] { invocation.run = [&app, shell] { return Completion(app, *shell); }; });
  AddExample(*completion, "source <(luxfit completion bash)", "");

  CLI::App* const man = app.add_subcommand("man", "manual pages (roff), made from what --help says");
  const auto name = std::make_shared<std::string>(), folder = std::make_shared<std::string>();
  man->add_option("COMMAND", *name, "the command to describe (default: luxfit itself)");
  man->add_option("-o,--out", *folder, "write all of them into this folder instead");
  man->final_callback([&app, &invocation, name, folder] {
    invocation.run = [&app, name, folder] { return Manual(app, *name, *folder); };
  });
  AddExample(*man, "luxfit man fit | man -l -",
             "LUXFIT-FIT(1)                    luxfit                   LUXFIT-FIT(1)\n...");

  CLI::App* const help = app.add_subcommand("help", "what --help says of luxfit or of a command");
  const auto of = std::make_shared<std::string>();
  help->add_option("COMMAND", *of, "the command to describe (default: luxfit itself)");
  help->final_callback([&app, &invocation, of] { invocation.run = [&app, of] { return Help(app, *of); }; });
  AddExample(*help, "luxfit help run", "");
}

}  // namespace luxfit
