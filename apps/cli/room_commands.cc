// Commands on the room that a run fitted.
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/cli/cli.h"
#include "apps/export_command.h"
#include "apps/suggest.h"

namespace luxfit {
namespace {

// What all of them share, added last.
template <typename Options>
void Complete(CLI::App& command, Invocation& invocation, const std::shared_ptr<Options>& options,
              int (*run)(const Options&)) {
  command.add_option("--session", options->session,
                     "the session file, where it is not where the run had it");
  AddJson(command, options->json);
  AddThreads(command, invocation);
  command.final_callback([&invocation, options, run] {
    options->command_line = invocation.command_line;
    invocation.run = [options, run] { return run(*options); };
  });
}

void AddExport(CLI::App& app, Invocation& invocation) {
  CLI::App* const command =
      app.add_subcommand("export", "the fitted room for other programs: .ies, .vtp, .ply, Radiance, EXR, CSV");
  const auto options = std::make_shared<ExportCommandOptions>();
  command->add_option("OUT", options->out, "folder of an earlier run")->required();
  command->add_option("--only", options->only, "of " + ListNames(ExportNames()) + " (default: all)")
      ->delimiter(',');
  command->add_option("-o,--out", options->folder, "folder to write into (default: OUT/export)");
  Complete(*command, invocation, options, ExportCommand);
  AddExample(*command, "luxfit export out --only radiance,csv",
             "radiance    19 files\n"
             "csv         8 files");
}

}  // namespace

void AddRoomCommands(CLI::App& app, Invocation& invocation) { AddExport(app, invocation); }

}  // namespace luxfit
