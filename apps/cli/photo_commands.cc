// Adds the commands that read values from the photos of a session or of a run.
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/cli/cli.h"
#include "apps/commands/result/glare_command.h"
#include "apps/commands/result/spot_command.h"

namespace luxfit {
namespace {

// Adds INPUT, which stands before what a command asks of the photos.
void AddPhotoInput(CLI::App& command, MeasuredInput& input) {
  command
      .add_option("INPUT", input.input,
                  "the folder of a run (cd/m2 by its luxmeter reading), or a session file (by "
                  "cdm2_per_count_s)")
      ->required();
}

// Adds the options that all of them share, as the last ones.
template <typename Options>
void CompletePhotoCommand(CLI::App& command, Invocation& invocation, const std::shared_ptr<Options>& options,
                          int (*run)(const Options&)) {
  command
      .add_option_function<double>(
          "--scale-sigma-percent", [options](double percent) { options->scale_sigma = percent / 100; },
          "relative sigma of the camera's scale, percent (default: that of the run's fit; of "
          "cdm2_per_count_s it is not known)")
      ->check(CLI::Range(0.0, 100.0));
  command.add_option("-o,--out", options->out,
                     "folder for the results, in its luminance/ (default: the folder of the run)");
  command.add_option("--session", options->session, "the session file, if it has moved since the run");
  AddJson(command, options->json);
  AddThreads(command, invocation);
  command.final_callback([&invocation, options, run] {
    options->command_line = invocation.command_line;
    invocation.run = [options, run] { return run(*options); };
  });
}

void AddSpot(CLI::App& app, Invocation& invocation) {
  CLI::App* const command =
      app.add_subcommand("spot", "the luminance of circles of photos, as a spot meter reads it");
  const auto options = std::make_shared<SpotCommandOptions>();
  AddPhotoInput(*command, *options);
  command
      ->add_option("SPOT", options->spots,
                   "PHOTO:X,Y (the photo as VIEW_STATE or by its file; its pixel, 0,0 being the centre of "
                   "the top-left one), or "
                   "one table .csv: photo,x_px,y_px[,radius_px]")
      ->required();
  command->add_option("--radius", options->radius_px, "radius of the circles, px")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 10000.0));
  CompletePhotoCommand(*command, invocation, options, SpotCommand);
  AddExample(*command, "luxfit spot out v00_all:240,180 v00_all:400,300",
             "photo       x px    y px  radius px  pixels  cd/m2                  spread %\n"
             "v00_all      240     180          5      81  17.16 ± 0.51              19.23\n"
             "v00_all      400     300          5      81  21.34 ± 0.44               0.98");
}

void AddGlare(CLI::App& app, Invocation& invocation) {
  CLI::App* const command = app.add_subcommand(
      "glare", "glare that photos show: vertical illuminance at the lens, UGR, DGP, glare sources");
  const auto options = std::make_shared<GlareCommandOptions>();
  AddPhotoInput(*command, *options);
  command->add_option("PHOTO", options->names, "photos as VIEW_STATE or by their files (default: all)");
  command
      ->add_option("--ev", options->vertical_lx,
                   "vertical illuminance at the lens of the one photo, lx, for photos that show less than a "
                   "hemisphere")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--threshold", options->threshold,
                   "luminance above which a pixel glares: cd/m2, or 5x for five times the photo's mean")
      ->capture_default_str();
  CompletePhotoCommand(*command, invocation, options, GlareCommand);
  AddExample(*command, "luxfit glare out v00_all --ev 400",
             "photo    field %  E_v lx            sources  L_b cd/m2  UGR                DGP\n"
             "v00_all     29.6  400 given               0      127.3  clipped            >= 0.183\n"
             "\n"
             "warning: 1 of 1 photos have pixels that are saturated in every exposure: ...");
}

}  // namespace

void AddPhotoCommands(CLI::App& app, Invocation& invocation) {
  AddSpot(app, invocation);
  AddGlare(app, invocation);
}

}  // namespace luxfit
