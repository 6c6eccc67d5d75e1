// Runs `luxfit room`: checks and draws a room, from a mesh or from the [scene] of a session.
//
// Prints size (m), volume (m3) where the room is closed, area by material (m2) and what is wrong with the
// surfaces; with `plan` writes a plan of them as SVG.
//
// Returns 0, and 1 where surfaces are black to the room (wound the wrong way) or surveyed tags do not lie on
// it. Throws std::runtime_error for bad input (exit status 2), ReadSession's errors included.
#ifndef LUXFIT_APPS_COMMANDS_ROOM_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_ROOM_COMMAND_H_

#include <string>

namespace luxfit {

struct RoomCommandOptions {
  std::string file;        // a session (.toml), or a mesh
  std::string unit = "m";  // of the mesh; a session has its own
  std::string plan;        // .svg to write; empty: none
  bool json = false;
};
int RoomCommand(const RoomCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_ROOM_COMMAND_H_
