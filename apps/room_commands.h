// Command lines of what is done with a fitted room: export, luxmap, commission, dim.
#ifndef LUXFIT_APPS_ROOM_COMMANDS_H_
#define LUXFIT_APPS_ROOM_COMMANDS_H_

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace luxfit {

// Adds the subcommands to the program; each with what runs it, once the command line is parsed.
std::vector<std::pair<CLI::App*, std::function<int()>>> AddRoomCommands(CLI::App& app,
                                                                        const std::string& command_line,
                                                                        int& threads);

}  // namespace luxfit

#endif  // LUXFIT_APPS_ROOM_COMMANDS_H_
