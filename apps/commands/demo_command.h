// Runs `luxfit demo`: the office that comes with luxfit, from photos to report.
//
// Looks for the office's folder beside the program (../share/luxfit/office) and in the source tree that it
// was built from. Throws std::runtime_error naming both where neither has it.
#ifndef LUXFIT_APPS_COMMANDS_DEMO_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_DEMO_COMMAND_H_

#include <string>

#include "apps/commands/commands.h"

namespace luxfit {

int DemoCommand(CommandOptions options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_DEMO_COMMAND_H_
