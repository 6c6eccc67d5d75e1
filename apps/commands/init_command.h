// `luxfit init`: a session to start from, out of a folder of photos and a mesh.
//
// Writes session.toml, photos.csv and luxmeter.csv into a folder and never over files that are there. Every
// line that was guessed ends in "# GUESS: why"; what nobody can guess stands as a comment with an example.
//
// Throws std::runtime_error for a folder without photos, a mesh that cannot be read, and files that exist.
#ifndef LUXFIT_APPS_COMMANDS_INIT_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_INIT_COMMAND_H_

#include <string>

namespace luxfit {

struct InitCommandOptions {
  std::string photos;  // folder, searched below too
  std::string mesh;
  std::string tags;       // tag map; empty: none
  std::string out = ".";  // folder of the session
  bool json = false;
};
int InitCommand(const InitCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INIT_COMMAND_H_
