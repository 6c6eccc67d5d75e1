#include "apps/cli/cli.h"

#include <CLI/CLI.hpp>

#include "apps/session/earlier_result.h"

namespace luxfit {

void AddExample(CLI::App& command, const std::string& typed, const std::string& output) {
  std::string text = "Example:\n  $ " + typed + "\n";
  size_t start = 0;
  while (start < output.size()) {
    const size_t end = std::min(output.find('\n', start), output.size());
    text += "  " + output.substr(start, end - start) + "\n";
    start = end + 1;
  }
  text.pop_back();
  command.footer(text);
}

void AddRunFolder(CLI::App& command, std::string& folder) {
  command.add_option("OUT", folder, "folder of an earlier run, or its result.json")
      ->required()
      ->transform(
          CLI::Validator([](std::string& named) { return named = RunFolderOf(named), std::string(); }, ""));
}

void AddEarlierResult(CLI::App& command, const std::string& flag, std::string& file,
                      const std::string& help) {
  command.add_option(flag, file, help)
      ->transform(
          CLI::Validator([](std::string& named) { return named = ResultFileOf(named), std::string(); }, ""));
}

void AddThreads(CLI::App& command, Invocation& invocation) {
  command.add_option("--threads", invocation.threads, "cores to use (0: all)")->check(CLI::NonNegativeNumber);
}

void AddJson(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "print the result as JSON on standard output");
}

}  // namespace luxfit
