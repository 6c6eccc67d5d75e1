#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/board_command.h"
#include "apps/commands.h"
#include "apps/form_factors_command.h"
#include "apps/process.h"
#include "apps/room_commands.h"
#include "apps/version.h"
#include "forward/form_factors.h"
#include "forward/threads.h"

namespace {

// Exit statuses of docs/session-format.md.
constexpr int kBadInput = 2, kMissingProgram = 3, kDefect = 70;

std::string CommandLine(int argc, char** argv) {
  std::string line;
  for (int i = 0; i < argc; ++i) line += (i == 0 ? "" : " ") + std::string(argv[i]);
  return line;
}

CLI::App* AddFormFactors(CLI::App& app, luxfit::FormFactorsCommandOptions& options, int& threads) {
  CLI::App* const sub =
      app.add_subcommand("formfactors", "form factors between the patches of a mesh, by any method");
  sub->add_option("MESH", options.mesh, "OBJ, PLY or glTF")->required();
  sub->add_option("-o,--out", options.file, "file to write, .csv or .json")->required();
  std::string methods;
  for (const luxfit::FormFactorMethod method : luxfit::AllFormFactorMethods())
    methods += (methods.empty() ? "" : " | ") + luxfit::ToString(method);
  sub->add_option("--method", options.method, methods)->capture_default_str();
  sub->add_option("--rays", options.rays, "rays over the hemisphere of a patch")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  sub->add_option("--patch-size", options.patch_size_m, "longest side of a patch, m")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  sub->add_option("--unit", options.unit, "of the mesh: m | cm | mm | in | ft")->capture_default_str();
  sub->add_flag("--json", options.json, "print the summary as JSON on standard output");
  sub->add_option("--threads", threads, "cores to use (0: all)")->check(CLI::NonNegativeNumber);
  return sub;
}

CLI::App* AddBoard(CLI::App& app, luxfit::BoardCommandOptions& options) {
  CLI::App* const sub =
      app.add_subcommand("board", "calibration boards and room tags to print, at true scale");
  const auto size = [&](const std::string& flag, double& value, const std::string& help) {
    sub->add_option(flag, value, help)->check(CLI::PositiveNumber);
  };
  sub->add_option("TYPE", options.type, "aprilgrid | chessboard | charuco | tags")->required();
  sub->add_option("-o,--out", options.file, "file to write, .pdf or .svg")->required();
  sub->add_option("--paper", options.paper, "A0 to A5, letter, legal, tabloid, or WIDTHxHEIGHT in mm")
      ->capture_default_str();
  sub->add_option("--columns", options.columns,
                  "tags, inner corners (chessboard) or squares (charuco) along a row")
      ->check(CLI::PositiveNumber);
  sub->add_option("--rows", options.rows, "the same along a column")->check(CLI::PositiveNumber);
  size("--tag-size", options.tag_size_m, "aprilgrid, tags: side of a black square, m (default: what fits)");
  size("--spacing", options.spacing, "aprilgrid: gap between black squares, in tag sizes (default: 0.3)");
  size("--square-size", options.square_size_m,
       "chessboard, charuco: side of a square, m (default: what fits)");
  size("--marker-size", options.marker_size_m, "charuco: side of a marker, m (default: 0.7 squares)");
  sub->add_option("--first-id", options.first_id, "aprilgrid, charuco")->check(CLI::NonNegativeNumber);
  sub->add_option("--ids", options.ids, "tags: ids and ranges, 0-11,20")->capture_default_str();
  sub->add_option("--family", options.family, "aprilgrid, tags: tag family")->capture_default_str();
  sub->add_option("--dictionary", options.dictionary, "charuco: OpenCV's name")->capture_default_str();
  sub->add_flag("--corner-squares", options.has_corner_squares,
                "aprilgrid: black squares between the tags' corners, as Kalibr prints");
  sub->add_option("--border-bits", options.border_bits,
                  "aprilgrid: cells of a tag's black border; 2: Kalibr's")
      ->capture_default_str()
      ->check(CLI::Range(1, 2));
  return sub;
}

// The whole fit instead of the forward model.
void AddFitCharts(CLI::App& chart, luxfit::CommandOptions& options) {
  luxfit::StabilityOptions& stability = options.stability_options;
  CLI::Option* const degrade = chart.add_flag(
      "--stability", options.stability,
      "degrade the session (noise, exposure, views, ...), fit it again, and chart success and error");
  CLI::Option* const fit =
      chart.add_flag("--fit", options.whole_fit,
                     "error of the whole fit against its time, over patches, views, states, ...");
  fit->excludes(degrade);
  chart.add_option("--trials", stability.trials, "of --stability, a level")
      ->capture_default_str()
      ->check(CLI::PositiveNumber)
      ->needs(degrade);
  chart.add_option("--seed", stability.seed, "of --stability's random numbers")
      ->capture_default_str()
      ->needs(degrade);
  chart.add_option("--only", stability.only, "degradations of --stability, by name (default: all)")
      ->delimiter(',')
      ->needs(degrade);
  const CLI::Option* const elements =
      chart.add_option("--elements", stability.elements, "observed elements that each fit uses")
          ->capture_default_str()
          ->check(CLI::PositiveNumber);
  const CLI::Option* const truth =
      chart.add_option("--truth", stability.truth_path,
                       "true luminaires as JSON (default: what the undegraded session gives)");
  chart.final_callback([degrade, fit, elements, truth] {
    if (degrade->count() + fit->count() > 0) return;
    for (const CLI::Option* const option : {elements, truth}) {
      if (option->count() > 0) throw CLI::RequiresError(option->get_name(), "--stability or --fit");
    }
  });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "luxfit: luminaires, reflectances and their uncertainty from photos of a room and luxmeter readings"};
  app.set_version_flag("--version", luxfit::kVersion);
  app.require_subcommand(1);
  luxfit::CommandOptions options;
  options.command_line = CommandLine(argc, argv);

  const auto add = [&](const std::string& name, const std::string& help, bool session,
                       int (*command)(const luxfit::CommandOptions&)) {
    CLI::App* sub = app.add_subcommand(name, help);
    if (session) {
      sub->add_option("SESSION", options.session, "the session file (TOML)")->required();
      sub->add_option("-o,--out", options.out, "folder for the results; nothing is written outside it")
          ->required();
    } else {
      sub->add_option("OUT", options.out, "folder of an earlier run")->required();
    }
    sub->add_flag("--json", options.json, "print the result as JSON on standard output");
    sub->add_option("--threads", options.threads, "cores to use (0: all)")->check(CLI::NonNegativeNumber);
    return std::make_pair(sub, command);
  };
  const std::vector<std::pair<CLI::App*, int (*)(const luxfit::CommandOptions&)>> commands = {
      add("run", "everything: register the photos, observe, fit, check against the luxmeter", true,
          luxfit::RunCommand),
      add("linearize", "photos to luminance: exposures, response, vignetting", true,
          luxfit::LinearizeCommand),
      add("calibrate", "intrinsics of cameras and rigs, from images of a board or of the room's tags", true,
          luxfit::CalibrateCommand),
      add("register", "a pose for every view, in the scene's frame", true, luxfit::RegisterCommand),
      add("fit", "luminaires and reflectances by inverting the radiosity model", true, luxfit::RunCommand),
      add("albedo", "albedo in detail: of a room after its fit, or of an object by photometric stereo", true,
          luxfit::AlbedoCommand),
      add("simulate", "illuminance at the readings' places, everything given and nothing fitted", true,
          luxfit::SimulateCommand),
      add("chart", "speed against accuracy of the forward model, everything given", true,
          luxfit::ChartCommand),
      add("check", "measured against predicted luxmeter readings of an earlier run", false,
          luxfit::CheckCommand)};

  app.get_subcommand("check")->add_option(
      "--subset", options.subset,
      "a row for the readings of this pattern too: id or id@state, * for any text");
  for (const char* name : {"run", "fit"}) {
    app.get_subcommand(name)->add_option("--luminaires", options.earlier_luminaires,
                                         "result.json of an earlier fit: its luminaires count as given, such "
                                         "as those read with covered walls");
  }
  for (const char* name : {"simulate", "chart"}) {
    app.get_subcommand(name)
        ->add_option("--error", options.error_percent,
                     "asked of patches, rays and bounces, percent of illuminance")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
  }
  CLI::App* const chart = app.get_subcommand("chart");
  chart->add_option("--budget", options.budget_s, "seconds in all; points that would take longer are skipped")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  chart->add_option("--result", options.earlier_result,
                    "result.json of a fit: its luminaires and reflectances count as given");

  AddFitCharts(*chart, options);

  luxfit::FormFactorsCommandOptions form_factors;
  form_factors.command_line = options.command_line;
  CLI::App* const form_factors_command = AddFormFactors(app, form_factors, options.threads);
  luxfit::BoardCommandOptions board;
  CLI::App* const board_command = AddBoard(app, board);
  const auto room_commands = luxfit::AddRoomCommands(app, options.command_line, options.threads);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : kBadInput;
  }
  const luxfit::ThreadLimit limit(options.threads);
  try {
    if (form_factors_command->parsed()) return luxfit::FormFactorsCommand(form_factors);
    if (board_command->parsed()) return luxfit::BoardCommand(board);
    for (const auto& [sub, run] : room_commands) {
      if (sub->parsed()) return run();
    }
    for (const auto& [sub, command] : commands) {
      if (sub->parsed()) return command(options);
    }
  } catch (const luxfit::MissingProgram& e) {
    std::fprintf(stderr, "luxfit: %s\n", e.what());
    return kMissingProgram;
  } catch (const std::runtime_error& e) {
    std::fprintf(stderr, "luxfit: %s\n", e.what());
    return kBadInput;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "luxfit: a defect of the program, please report it with the session: %s\n",
                 e.what());
    return kDefect;
  }
  return kDefect;
}
