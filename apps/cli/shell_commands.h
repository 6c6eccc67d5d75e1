// `luxfit completion` and `luxfit man`: scripts and pages made from the command line's own help.
#ifndef LUXFIT_APPS_CLI_SHELL_COMMANDS_H_
#define LUXFIT_APPS_CLI_SHELL_COMMANDS_H_

#include "apps/cli/cli.h"

namespace luxfit {

// Added last: they describe what was added before, and themselves.
void AddShellCommands(CLI::App& app, Invocation& invocation);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CLI_SHELL_COMMANDS_H_
