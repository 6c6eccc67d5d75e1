// Adds the commands on the room that a run fitted.
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/cli/cli.h"
#include "apps/commands/result/advise_command.h"
#include "apps/commands/result/commission_command.h"
#include "apps/commands/result/dim_command.h"
#include "apps/commands/result/export_command.h"
#include "apps/commands/result/luxmap_command.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

// Adds the options that all of them share, as the last ones.
template <typename Options>
void Complete(CLI::App& command, Invocation& invocation, const std::shared_ptr<Options>& options,
              int (*run)(const Options&)) {
  command.add_option("--session", options->session, "the session file, if it has moved since the run");
  AddJson(command, options->json);
  AddThreads(command, invocation);
  command.final_callback([&invocation, options, run] {
    options->command_line = invocation.command_line;
    invocation.run = [options, run] { return run(*options); };
  });
}

void AddExport(CLI::App& app, Invocation& invocation) {
  CLI::App* const command = app.add_subcommand(
      "export", "the fitted room for other programs: .ies, .vtp, .ply, Radiance, EXR, CSV");
  const auto options = std::make_shared<ExportCommandOptions>();
  AddRunFolder(*command, options->out);
  command->add_option("--only", options->only, "of " + ListNames(ExportNames()) + " (default: all)")
      ->delimiter(',');
  command->add_option("-o,--out", options->folder, "folder to write into (default: OUT/export)");
  Complete(*command, invocation, options, ExportCommand);
  AddExample(*command, "luxfit export out --only radiance,csv",
             "radiance    19 files\n"
             "csv         8 files");
}

void AddLuxmap(CLI::App& app, Invocation& invocation) {
  CLI::App* const command =
      app.add_subcommand("luxmap", "new photos of a fitted room as maps of illuminance, without another fit");
  const auto options = std::make_shared<LuxmapCommandOptions>();
  AddRunFolder(*command, options->out);
  command
      ->add_option("PHOTO", options->photos,
                   "photos, or one table .csv: file,camera,view[,exposure_s,time,aperture,iso]")
      ->required();
  CLI::Option* const view =
      command->add_option("--view", options->view, "the view of the run from which they were taken");
  command
      ->add_option_function<std::string>(
          "--pose", [options](const std::string&) { options->pose_from_tags = true; },
          "tags: find the camera's pose from the room's tags")
      ->check(CLI::IsMember({"tags"}))
      ->excludes(view);
  command->add_option("--camera", options->camera, "the camera's id (default: the only one)");
  command->add_option("--exposure-s", options->exposure_s, "exposure time, s (default: the photo's metadata)")
      ->check(CLI::PositiveNumber);
  command->add_option("--state", options->state,
                      "the state that should be on; warns of luminaires that differ");
  command->add_option("-o,--out", options->folder, "folder to write into (default: OUT/luxmap)");
  Complete(*command, invocation, options, LuxmapCommand);
  AddExample(*command, "luxfit luxmap out evening.png --view v00 --exposure-s 0.206",
             "evening.png : 90 % of the pixels have a known illuminance\n"
             "  luminaire A          at 0.30 ± 0.00\n"
             "  ...\n"
             "  place        seen lx             predicted lx\n"
             "  L1           -                   125.59 ± 2.56");
}

void AddCommission(CLI::App& app, Invocation& invocation) {
  CLI::App* const command = app.add_subcommand(
      "commission",
      "measured against designed, and the dimming levels that reach targets at the least power");
  const auto options = std::make_shared<CommissionCommandOptions>();
  AddRunFolder(*command, options->out);
  command->add_option("--design", options->design,
                      "TOML: [[luminaire]] as in a session, [power_w], [[point]] with illuminance_lx");
  command->add_option("--targets", options->targets, "TOML: [[area]] as for luxfit report");
  command->add_option("-o,--out", options->folder, "folder to write into (default: OUT/commission)");
  Complete(*command, invocation, options, CommissionCommand);
  AddExample(
      *command, "luxfit commission out --design design.toml",
      "luminaire  fitted as  moved m  aim deg  flux %           light elsewhere %  verdict\n"
      "A          A            0.002      0.0  -0.2 ± 3.9                     0.0  ok\n"
      "B          B            0.004      0.0  -19.4 ± 3.2                    0.0  dimmed or weak: flux "
      "by -19.4 ± 3.2 %");
}

void AddDim(CLI::App& app, Invocation& invocation) {
  CLI::App* const command =
      app.add_subcommand("dim", "which luminaires can be dimmed unseen by the people present");
  const auto options = std::make_shared<DimCommandOptions>();
  AddRunFolder(*command, options->out);
  command
      ->add_option("--person", options->persons,
                   "x,y,z,dx,dy,dz (eye in m, direction of the gaze), a .toml of [[observer]] or a .csv; "
                   "may be given again")
      ->required();
  command
      ->add_option("--drop-percent", options->drop_percent,
                   "drop of the light at each eye that nobody notices, percent")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 100.0));
  command->add_option("--state", options->state,
                      "the state that is on now (default: the state with the most on)");
  command->add_option("--design", options->design, "TOML with [power_w] (default: 100 lm/W)");
  command->add_option("-o,--out", options->folder, "folder to write into (default: OUT/dim)");
  Complete(*command, invocation, options, DimCommand);
  AddExample(*command, "luxfit dim out --person 1.0,1.2,1.2,-1,0,0",
             "luminaire    now  alone down to  together down to  power W\n"
             "A           1.00           0.86              1.00     35.9\n"
             "B           1.00           0.43              0.57     16.6\n"
             "...\n"
             "person 1: light at the eye 117.5 lx, drops by 10.0 ± 0.02 %\n"
             "63.6 W of 84.5 W: 24.8 % saved");
}

void AddAdvise(CLI::App& app, Invocation& invocation) {
  CLI::App* const command = app.add_subcommand(
      "advise", "which photo or reading to take first or next: what each would tell of fluxes and positions");
  const auto options = std::make_shared<AdviseCommandOptions>();
  command
      ->add_option("INPUT", options->input,
                   "the folder of a run; or a session file, or its folder, before the first photo")
      ->required();
  command->add_option(
      "--of", options->of,
      "what to know better: flux | position | readings | a luminaire (default: flux and position)");
  command->add_option("--only", options->only, "photos | readings (default: both)")
      ->check(CLI::IsMember({"photos", "readings"}));
  command
      ->add_option("--top", options->top,
                   "how many to name, each given those before (default: 5 of a run, 12 of a session)")
      ->check(CLI::Range(1, 50));
  command->add_option(
      "--photos", options->photo_table,
      "places where a camera may stand, CSV: id,x_m,y_m,z_m,dx,dy,dz[,state] (default: a grid)");
  command->add_option("--readings", options->reading_table,
                      "places of the luxmeter, CSV: id,x_m,y_m,z_m,nx,ny,nz,state (default: a grid)");
  command->add_option("-o,--out", options->out,
                      "folder for advise.json and advise.svg (default: that of the run; of a session, none)");
  command->add_option("--plan", options->plan, "where to draw the plan (default: advise.svg in that folder)");
  Complete(*command, invocation, options, AdviseCommand);
  AddExample(*command, "luxfit advise out --only photos --of position --top 2",
             "worst now: position of C 32 mm\n"
             "1  photograph state C from (2.50, 3.50, 1.60), looking at wall (-90 deg from +x): position of "
             "C 32 -> 6.9 mm\n"
             "2  photograph state evening from (1.50, 2.50, 1.60), looking at wall_accent (0 deg from +x): "
             "position of D "
             "13 -> 6.3 mm");
}

}  // namespace

void AddRoomCommands(CLI::App& app, Invocation& invocation) {
  AddExport(app, invocation);
  AddLuxmap(app, invocation);
  AddCommission(app, invocation);
  AddDim(app, invocation);
  AddAdvise(app, invocation);
}

}  // namespace luxfit
