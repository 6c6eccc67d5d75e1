// Describes the command line as data, from which completion scripts and manual pages are made.
#ifndef LUXFIT_APPS_CLI_DESCRIBE_H_
#define LUXFIT_APPS_CLI_DESCRIBE_H_

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace luxfit {

struct OptionDescription {
  std::vector<std::string> flags;  // "-o", "--out"; a positional has its name alone
  bool is_positional = false;
  bool takes_value = false;
  bool is_required = false;
  std::string help;
};

struct CommandDescription {
  std::string name, help, example;
  std::vector<OptionDescription> options;
};

// Returns the subcommands in the order of --help.
std::vector<CommandDescription> DescribeCommands(const CLI::App& app);

// Return scripts for bash-completion and zsh: commands, their options, and files as values.
std::string BashCompletion(const std::vector<CommandDescription>& commands);
std::string ZshCompletion(const std::vector<CommandDescription>& commands);

// Return manual pages (roff, section 1): luxfit(1) lists the commands, luxfit-NAME(1) describes one of them.
std::string OverviewManual(const std::vector<CommandDescription>& commands, const std::string& about,
                           const std::string& version);
std::string CommandManual(const CommandDescription& command, const std::string& version);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CLI_DESCRIBE_H_
