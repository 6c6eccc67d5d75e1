// Adds `luxfit completion` and `luxfit man`, whose output is made from the help of the command line.
#ifndef LUXFIT_APPS_CLI_SHELL_COMMANDS_H_
#define LUXFIT_APPS_CLI_SHELL_COMMANDS_H_

#include "apps/cli/cli.h"

namespace luxfit {

// Must be added last, since they describe all commands added before, and themselves.
void AddShellCommands(CLI::App& app, Invocation& invocation);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CLI_SHELL_COMMANDS_H_
