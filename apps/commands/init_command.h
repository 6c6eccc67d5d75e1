// Runs `luxfit init`: drafts a session from a folder of photos and the room: a mesh, three lengths, or where the
// tags hang.
//
// Writes session.toml, photos.csv and luxmeter.csv into a folder and never overwrites a file. Every guessed
// line ends in "# GUESS: why". A value that cannot be guessed stands as a comment with an example. A luxmeter.csv that
// lies there already is taken up as it is.
//
// Throws std::runtime_error for a folder without photos, a mesh or readings that cannot be read, a session or a
// photo table that exists, and where nothing tells the room.
#ifndef LUXFIT_APPS_COMMANDS_INIT_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_INIT_COMMAND_H_

#include <string>
#include <vector>

namespace luxfit {

struct InitCommandOptions {
  std::string photos;             // folder, searched with its subfolders
  std::string mesh;               // empty: none
  std::vector<std::string> size;  // m: {"6", "4", "2.8"} or {"6x4x2.8"}; empty: guessed from the tags
  std::string tags;               // tag map; empty: none
  std::string out = ".";          // folder of the session
  bool json = false;
};
int InitCommand(const InitCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INIT_COMMAND_H_
