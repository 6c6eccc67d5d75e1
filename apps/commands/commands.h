// Runs the subcommands. Each returns the process's exit status: 0 done, 1 the data do not determine what was
// asked.
//
// Throws std::runtime_error for bad input; main then ends with exit status 2.
// Source: docs/session-format.md, "Commands".
#ifndef LUXFIT_APPS_COMMANDS_COMMANDS_H_
#define LUXFIT_APPS_COMMANDS_COMMANDS_H_

#include <string>

#include "apps/commands/study/stage_fit_chart.h"
#include "apps/commands/study/stage_stability.h"

namespace luxfit {

struct CommandOptions {
  std::string session;       // path of session.toml
  std::string out;           // folder; nothing is written outside it
  std::string command_line;  // as typed, for the artifacts
  bool json = false;         // print the result as JSON on standard output
  bool prints = true;        // run and fit: print the result on standard output
  int threads = 0;           // 0: all cores
  // For run, fit and albedo:
  bool dry_run = false;  // tell what would run and why
  bool fresh = false;    // reuse nothing of an earlier run
  // For simulate and chart:
  double error_percent = 1;
  std::string subset;              // for check: a pattern of readings with a row of its own
  std::string earlier_luminaires;  // for run and fit: path of a result.json whose luminaires count as given
  // For chart:
  double budget_s = 120;
  std::string earlier_result;  // path of a result.json whose luminaires and reflectances count as given
  bool stability = false;      // chart the whole fit instead of the forward model
  StabilityOptions stability_options;
  bool whole_fit = false;  // error against time of the whole fit; elements and truth as in stability_options
};

// RunCommand runs all stages and writes OUT/report.html; FitCommand ends with OUT/result.json.
int RunCommand(const CommandOptions& options);
int FitCommand(const CommandOptions& options);
// Runs the forward model only; writes OUT/illuminance.csv and OUT/stages/simulate.json.
int SimulateCommand(const CommandOptions& options);
// Charts speed against accuracy of the forward model; writes OUT/chart.csv, OUT/chart.svg and
// OUT/stages/chart.json. Or charts the stability of the fit (apps/commands/study/stage_stability.h), or its error
// against time (apps/commands/study/stage_fit_chart.h).
int ChartCommand(const CommandOptions& options);
// Converts pixels to luminance by exposures, response and vignetting; writes OUT/stages/linearize.json.
int LinearizeCommand(const CommandOptions& options);
// Calibrates cameras from images of boards or of the room's tags; writes OUT/stages/calibrate.json and files
// of intrinsics (apps/stages/calibrate/stage_calibrate.h).
int CalibrateCommand(const CommandOptions& options);
int RegisterCommand(const CommandOptions& options);
// Estimates the albedo of a room (after all stages of RunCommand), or of an object by photometric stereo.
// Writes OUT/result.json and the files of apps/stages/albedo/stage_albedo.h and apps/stages/albedo/stage_stereo.h.
int AlbedoCommand(const CommandOptions& options);
// Reads OUT/result.json.
int CheckCommand(const CommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_COMMANDS_H_
