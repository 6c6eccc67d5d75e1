#include "apps/cli/shell_commands.h"

#include <CLI/CLI.hpp>
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
}

}  // namespace luxfit
