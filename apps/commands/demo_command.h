// Runs `luxfit demo`: the office that comes with luxfit, from photos to report.
//
// Looks for the office's folder beside the program (../share/luxfit/office) and in the source tree that it
// was built from. Throws std::runtime_error naming both where neither has it.
#ifndef LUXFIT_APPS_COMMANDS_DEMO_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_DEMO_COMMAND_H_

#include <string>

namespace luxfit {

struct DemoCommandOptions {
  std::string out;           // folder; nothing is written outside it
  std::string command_line;  // as typed, for the artifacts
  bool json = false;         // print the result as JSON on standard output
};
int DemoCommand(const DemoCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_DEMO_COMMAND_H_
