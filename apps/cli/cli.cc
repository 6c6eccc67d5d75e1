#include "apps/cli/cli.h"

#include <CLI/CLI.hpp>

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

void AddThreads(CLI::App& command, Invocation& invocation) {
  command.add_option("--threads", invocation.threads, "cores to use (0: all)")->check(CLI::NonNegativeNumber);
}

void AddJson(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "print the result as JSON on standard output");
}

}  // namespace luxfit
