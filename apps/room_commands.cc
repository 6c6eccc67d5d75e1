#include "apps/room_commands.h"

#include <memory>

#include "apps/export_command.h"
#include "apps/suggest.h"

namespace luxfit {
namespace {

using RoomCommand = std::pair<CLI::App*, std::function<int()>>;

// What all of them share. The options live as long as the function that uses them.
template <typename Options>
RoomCommand Added(CLI::App& sub, const std::shared_ptr<Options>& options, int (*run)(const Options&),
                  int& threads) {
  sub.add_option("OUT", options->out, "folder of an earlier run")->required();
  sub.add_option("--session", options->session, "the session file, where it is not where the run had it");
  sub.add_flag("--json", options->json, "print the result as JSON on standard output");
  sub.add_option("--threads", threads, "cores to use (0: all)")->check(CLI::NonNegativeNumber);
  return {&sub, [options, run] { return run(*options); }};
}

RoomCommand AddExport(CLI::App& app, const std::string& command_line, int& threads) {
  const auto options = std::make_shared<ExportCommandOptions>();
  options->command_line = command_line;
  CLI::App* const sub =
      app.add_subcommand("export", "the fitted room for other programs: .ies, .vtp, .ply, Radiance, EXR, CSV");
  sub->add_option("--only", options->only, "of " + ListNames(ExportNames()) + " (default: all)")->delimiter(',');
  sub->add_option("-o,--out", options->folder, "folder to write into (default: OUT/export)");
  return Added(*sub, options, ExportCommand, threads);
}

}  // namespace

std::vector<std::pair<CLI::App*, std::function<int()>>> AddRoomCommands(CLI::App& app,
                                                                        const std::string& command_line,
                                                                        int& threads) {
  return {AddExport(app, command_line, threads)};
}

}  // namespace luxfit
