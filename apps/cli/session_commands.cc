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

// Adds what all commands on a session have beside their inputs.
template <typename Options>
void AddSessionOptions(CLI::App* command, Invocation& invocation, const std::shared_ptr<Options>& options,
                       int (*run)(const Options&)) {
  command->add_option("-o,--out", options->out, "folder for the results; nothing is written outside it")
      ->required();
  AddJson(*command, options->json);
  AddThreads(*command, invocation);
  command->final_callback([&invocation, options, run] {
    options->command_line = invocation.command_line;
    invocation.run = [options, run] { return run(*options); };
  });
}

template <typename Options>
Added<Options> AddSessionCommand(CLI::App& app, Invocation& invocation, const std::string& name,
                                 const std::string& help, int (*run)(const Options&)) {
  CLI::App* const command = app.add_subcommand(name, help);
  const auto options = std::make_shared<Options>();
  command->add_option("SESSION", options->session, "the session file (TOML)")->required();
  AddSessionOptions(command, invocation, options, run);
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

void AddFitOptions(const Added<RunCommandOptions>& added) {
  AddRunOptions(added);
  added.command->add_flag(
      "--apply", added.options->applies,
      "where the data contradict the session and one explanation stands alone (states_as_if, photos_as_if, "
      "readings_as_if, mesh_as_if), take it as right, fit again, and say so; the file stays as it is");
  AddEarlierResult(*added.command, "--luminaires", added.options->earlier_luminaires,
                   "earlier fit (folder or result.json): its luminaires count as given, such as those read "
                   "with covered walls");
}

void AddRun(CLI::App& app, Invocation& invocation) {
  const auto run = AddSessionCommand(
      app, invocation, "run",
      "everything: register the photos, observe, fit, check against the luxmeter, report", RunCommand);
  AddFitOptions(run);
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
  AddFitOptions(fit);
  AddExample(*fit.command, "luxfit fit office/session.toml -o out",
             "session office: done\n"
             "8 views registered, reprojection RMS 0.031 px\n"
             "\n"
             "luminaire  position m (x, y, z), 1 sigma mm             flux lm           distribution\n"
             "...");
}

void AddCalibrate(CLI::App& app, Invocation& invocation) {
  CLI::App* const command = app.add_subcommand(
      "calibrate", "intrinsics of cameras and rigs, from photos of a board or of the room's tags");
  const auto options = std::make_shared<CalibrateCommandOptions>();
  command
      ->add_option("INPUT", options->inputs,
                   "photos of a board, or folders of them: each folder is a camera; or a session file (TOML)")
      ->required();
  command->add_option("--board", options->board,
                      "what photos show: chessboard:COLUMNSxROWS:SQUARE_M (inner corners), "
                      "charuco:COLUMNSxROWS:SQUARE_M[:MARKER_M[:DICTIONARY]] (squares) or "
                      "aprilgrid:COLUMNSxROWS:TAG_M[:GAP_IN_TAGS[:FAMILY]]");
  command->add_option(
      "--rig", options->rig,
      "which photos of several cameras were taken together: auto, names, numbers, order or none");
  AddSessionOptions(command, invocation, options, CalibrateCommand);
  AddExample(*command, "luxfit calibrate left/*.jpg right/*.jpg --board chessboard:9x6:0.025 -o out",
             "session left, right: done\n"
             "photos of left: 13, in left\n"
             "photos of right: 13, in right\n"
             "sets of left, right: 13, by numbers, left01.jpg with right01.jpg and so on\n"
             "26 images, opencv4: RMS per axis 0.130 px, held out 0.131 px, 0.4 % outliers\n"
             "...\n"
             "  left to right: baseline 0.083138 ± 0.000035 m, rotation 0.435 ± 0.047 degrees");
}

void AddLinearize(CLI::App& app, Invocation& invocation) {
  const auto linearize = AddSessionCommand(
      app, invocation, "linearize", "photos to luminance: exposures, response, vignetting", LinearizeCommand);
  linearize.command->add_flag("--hdr", linearize.options->writes_pictures,
                              "write every photo, or merged bracket, as a picture of luminance into "
                              "OUT/luminance: Radiance .hdr with its "
                              "view (cd/m2 = 179 (0.265 R + 0.670 G + 0.065 B)) and .exr; relative where "
                              "cdm2_per_count_s is unknown");
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
