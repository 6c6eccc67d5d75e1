// The command line: every subcommand with its options, help and an example with its output.
//
// Parsing chooses what to run, it runs nothing. Groups of commands are one file each: cli/start_commands.cc
// (before there is a session), cli/session_commands.cc (on a session), cli/forward_commands.cc (the forward
// model), cli/result_commands.cc (on what a run left), cli/room_commands.cc (on the room that it fitted).
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
  std::function<int()> run;  // the command's; returns the exit status
};

void AddStartCommands(CLI::App& app, Invocation& invocation);
void AddSessionCommands(CLI::App& app, Invocation& invocation);
void AddForwardCommands(CLI::App& app, Invocation& invocation);
void AddResultCommands(CLI::App& app, Invocation& invocation);
void AddRoomCommands(CLI::App& app, Invocation& invocation);

// Under the options of a command's help: what to type and what comes back.
void AddExample(CLI::App& command, const std::string& typed, const std::string& output);

// --threads and --json, which nearly all have.
void AddThreads(CLI::App& command, Invocation& invocation);
void AddJson(CLI::App& command, bool& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CLI_CLI_H_
