// `luxfit demo`: the office that comes with luxfit, run from photos to report.
//
// Looks for the office's folder beside the program (../share/luxfit/office) and in the source tree it was
// built from. Throws std::runtime_error naming both where it is in neither.
#ifndef LUXFIT_APPS_COMMANDS_DEMO_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_DEMO_COMMAND_H_

#include <string>

#include "apps/commands/commands.h"

namespace luxfit {

int DemoCommand(CommandOptions options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_DEMO_COMMAND_H_
