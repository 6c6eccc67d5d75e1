// Runs `luxfit demo`: a room that comes with luxfit, from photos to report.
//
// Looks for the room's folder beside the program (../share/luxfit/ROOM) and in the source tree that it was
// built from. Throws std::runtime_error naming both where neither has it.
#ifndef LUXFIT_APPS_COMMANDS_DEMO_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_DEMO_COMMAND_H_

#include <string>
#include <vector>

namespace luxfit {

// Returns the rooms that come with luxfit, the one to begin with first.
const std::vector<std::string>& DemoRooms();

struct DemoCommandOptions {
  std::string room = DemoRooms().front();
  std::string out;           // folder; nothing is written outside it
  std::string command_line;  // as typed, for the artifacts
  bool json = false;         // print the result as JSON on standard output
};
int DemoCommand(const DemoCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_DEMO_COMMAND_H_
