// Adds the commands on a session: from photos to luminaires.
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/cli/cli.h"
#include "apps/commands/commands.h"

namespace luxfit {
namespace {

template <typename Options>
struct Added {
  CLI::App* command;
  std::shared_ptr<Options> options;
};

template <typename Options>
Added<Options> AddSessionCommand(CLI::App& app, Invocation& invocation, const std::string& name,
                                 const std::string& help, int (*run)(const Options&)) {
  CLI::App* const command = app.add_subcommand(name, help);
  const auto options = std::make_shared<Options>();
  command->add_option("SESSION", options->session, "the session file (TOML)")->required();
  command->add_option("-o,--out", options->out, "folder for the results; nothing is written outside it")
      ->required();
  AddJson(*command, options->json);
  AddThreads(*command, invocation);
  command->final_callback([&invocation, options, run] {
    options->command_line = invocation.command_line;
    invocation.run = [options, run] { return run(*options); };
  });
  return {command, options};
}

template <typename Options>
void AddRunOptions(const Added<Options>& added) {
  added.command->add_flag("--dry-run", added.options->dry_run,
                          "tell which stages would run and why, and do nothing");
  added.command->add_flag("--fresh", added.options->fresh, "reuse nothing of an earlier run in OUT");
  added.command
      ->add_option(
          "--budget", added.options->budget_s,
          "seconds after which the fit ends with the best state so far, marked as stopped (exit 1); Ctrl-C "
          "and SIGTERM end it likewise")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
}

void AddLuminairesOption(const Added<RunCommandOptions>& added) {
  AddRunOptions(added);
  AddEarlierResult(*added.command, "--luminaires", added.options->earlier_luminaires,
                   "earlier fit (folder or result.json): its luminaires count as given, such as those read "
                   "with covered walls");
}

void AddRun(CLI::App& app, Invocation& invocation) {
  const auto run = AddSessionCommand(
      app, invocation, "run",
      "everything: register the photos, observe, fit, check against the luxmeter, report", RunCommand);
  AddLuminairesOption(run);
  AddExample(*run.command, "luxfit run office/session.toml -o out",
             "session office: done\n"
             "8 views registered, reprojection RMS 0.031 px\n"
             "\n"
             "luminaire  position m (x, y, z), 1 sigma mm             flux lm           distribution\n"
             "A           1.500  2.000  2.791  ± 3.4 1.8 3.2             3613 ± 74         lambertian "
             "rectangle 0.61 x 0.61 m\n"
             "...\n"
             "checked 47 readings: mean error 1.20 lx = 0.99 % of the mean reading, largest 3.13 %");
  const auto fit = AddSessionCommand(
      app, invocation, "fit", "luminaires and reflectances by inverting the radiosity model", FitCommand);
  AddLuminairesOption(fit);
  AddExample(*fit.command, "luxfit fit office/session.toml -o out",
             "session office: done\n"
             "8 views registered, reprojection RMS 0.031 px\n"
             "\n"
             "luminaire  position m (x, y, z), 1 sigma mm             flux lm           distribution\n"
             "...");
}

void AddCalibrate(CLI::App& app, Invocation& invocation) {
  const auto calibrate = AddSessionCommand(
      app, invocation, "calibrate",
      "intrinsics of cameras and rigs, from images of a board or of the room's tags", CalibrateCommand);
  AddExample(*calibrate.command,
             "luxfit calibrate mine/session.toml -o out   # a session whose cameras name images of a board",
             "session stereo: done\n"
             "13 images, opencv4: RMS per axis 0.120 px, held out 0.120 px, 0.1 % outliers\n"
             "  left     f 534.03 534.16 px (± 0.43), c 341.60 234.28; direction uncertain by 0.12 px in the "
             "middle\n"
             "...");
}

void AddLinearize(CLI::App& app, Invocation& invocation) {
  const auto linearize = AddSessionCommand(
      app, invocation, "linearize", "photos to luminance: exposures, response, vignetting", LinearizeCommand);
  AddExample(*linearize.command, "luxfit linearize office/session.toml -o out",
             "session office: 49 views and states\ncamera cam0: response linear");
}

void AddRegister(CLI::App& app, Invocation& invocation) {
  const auto command = AddSessionCommand(app, invocation, "register",
                                         "a pose for every view, in the scene's frame", RegisterCommand);
  AddExample(*command.command, "luxfit register office/session.toml -o out",
             "v00      3 tags, reprojection RMS 0.029 px, camera centre ± 1.0 1.2 1.3 mm\n"
             "v01      2 tags, reprojection RMS 0.009 px, camera centre ± 1.0 1.4 1.4 mm\n"
             "...\n"
             "warning: View v08 shows no surveyed tag that can be used; it is left out.");
}

void AddAlbedo(CLI::App& app, Invocation& invocation) {
  const auto albedo = AddSessionCommand(
      app, invocation, "albedo",
      "albedo in detail: of a room after its fit, or of an object by photometric stereo", AlbedoCommand);
  AddRunOptions(albedo);
  AddExample(*albedo.command, "luxfit albedo office/session.toml -o out",
             "material           albedo    sigma  from radiosity    sigma  detail     unlike the rest\n"
             "wall               0.7040   0.0019          0.7040   0.0019  material   0 of 3998 elements\n"
             "...");
}

}  // namespace

void AddSessionCommands(CLI::App& app, Invocation& invocation) {
  AddRun(app, invocation);
  AddCalibrate(app, invocation);
  AddLinearize(app, invocation);
  AddRegister(app, invocation);
  AddAlbedo(app, invocation);
}

}  // namespace luxfit
