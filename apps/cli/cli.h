// Defines the command line: every subcommand with its options, its help, and an example with its output.
//
// Parsing selects what to run; it runs nothing. Each group of commands is one file: cli/start_commands.cc
// (before there is a session), cli/session_commands.cc (on a session), cli/forward_commands.cc (the forward
// model), cli/result_commands.cc (on the results of a run), cli/room_commands.cc (on the room that a run
// fitted), cli/photo_commands.cc (on the photos of a session or of a run).
#ifndef LUXFIT_APPS_CLI_CLI_H_
#define LUXFIT_APPS_CLI_CLI_H_

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace luxfit {

struct Invocation {
  std::string command_line;  // as typed, for the artifacts
  int threads = 0;           // 0: all cores
  std::function<int()> run;  // runs the command; returns the exit status
};

void AddStartCommands(CLI::App& app, Invocation& invocation);
void AddSessionCommands(CLI::App& app, Invocation& invocation);
void AddForwardCommands(CLI::App& app, Invocation& invocation);
void AddResultCommands(CLI::App& app, Invocation& invocation);
void AddRoomCommands(CLI::App& app, Invocation& invocation);
void AddPhotoCommands(CLI::App& app, Invocation& invocation);

// Adds an example below the options of a command's help: what to type, and its output.
void AddExample(CLI::App& command, const std::string& typed, const std::string& output);

// Adds the positional OUT: the folder of an earlier run, or the result.json in it.
void AddRunFolder(CLI::App& command, std::string& folder);
// Adds a flag that names an earlier result in either way; `file` becomes the path of its result.json.
void AddEarlierResult(CLI::App& command, const std::string& flag, std::string& file, const std::string& help);

// Add --threads and --json, which nearly all commands have.
void AddThreads(CLI::App& command, Invocation& invocation);
void AddJson(CLI::App& command, bool& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CLI_CLI_H_
