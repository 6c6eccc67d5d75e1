// Runs the subcommands. Each returns the process's exit status: 0 done, 1 the data do not determine what was
// asked.
//
// Throws std::runtime_error for bad input; main then ends with exit status 2.
// Source: docs/session-format.md, "Commands".
#ifndef LUXFIT_APPS_COMMANDS_COMMANDS_H_
#define LUXFIT_APPS_COMMANDS_COMMANDS_H_

#include <string>
#include <vector>

#include "apps/commands/study/stage_fit_chart.h"
#include "apps/commands/study/stage_stability.h"

namespace luxfit {

// Holds what every command on a session takes.
struct SessionCommandOptions {
  std::string session;       // path of session.toml
  std::string out;           // folder; nothing is written outside it
  std::string command_line;  // as typed, for the artifacts
  bool json = false;         // print the result as JSON on standard output
};

constexpr double kFitBudgetS = 120;

struct RunCommandOptions : SessionCommandOptions {
  bool dry_run = false;            // tell what would run and why
  bool fresh = false;              // reuse nothing of an earlier run
  std::string earlier_luminaires;  // path of a result.json whose luminaires count as given; empty: none
  bool prints = true;              // print the result on standard output
  double budget_s = kFitBudgetS;   // of the fit, which then ends with the best state so far
  bool applies = false;            // correct the session by explanations that stand alone
};
// RunCommand runs all stages and writes OUT/report.html; FitCommand ends with OUT/result.json.
int RunCommand(const RunCommandOptions& options);
int FitCommand(const RunCommandOptions& options);

struct SimulateCommandOptions : SessionCommandOptions {
  double error_percent = 1;  // error that patches, rays and bounces may cause, of illuminance
};
// Runs the forward model only; writes OUT/illuminance.csv and OUT/stages/simulate.json.
int SimulateCommand(const SimulateCommandOptions& options);

struct ChartCommandOptions : SessionCommandOptions {
  double error_percent = 1;    // error asked of the automatic choice
  double budget_s = 120;       // points that would take longer are skipped
  int threads = 0;             // number asked for; 0: all cores
  std::string earlier_result;  // path of a result.json whose luminaires and reflectances count as given
  bool stability = false;      // chart the whole fit instead of the forward model
  StabilityOptions stability_options;
  bool whole_fit = false;  // error against time of the whole fit; elements and truth as in stability_options
  EarlierChart before;     // of the same kind, drawn in the same pictures
};
// Charts speed against accuracy of the forward model; writes OUT/chart.csv, OUT/chart.svg and
// OUT/stages/chart.json. Or charts the stability of the fit (apps/commands/study/stage_stability.h), or its error
// against time (apps/commands/study/stage_fit_chart.h).
int ChartCommand(const ChartCommandOptions& options);

struct LinearizeCommandOptions : SessionCommandOptions {
  bool writes_pictures = false;  // OUT/luminance/VIEW_STATE.hdr and .exr (apps/export/luminance_pictures.h)
};
// Converts pixels to luminance by exposures, response and vignetting; writes OUT/stages/linearize.json.
int LinearizeCommand(const LinearizeCommandOptions& options);
struct CalibrateCommandOptions : SessionCommandOptions {
  std::vector<std::string>
      inputs;         // one session file; or photos of a board and folders of them, `session` being empty
  std::string board;  // what photos show, as apps/stages/calibrate/board_text.h has it
  std::string rig;    // how photos pair up: one of RigRules; empty: auto
};
// Calibrates cameras from images of boards or of the room's tags; writes OUT/stages/calibrate.json and files
// of intrinsics (apps/stages/calibrate/stage_calibrate.h).
int CalibrateCommand(const CalibrateCommandOptions& options);
int RegisterCommand(const SessionCommandOptions& options);

struct AlbedoCommandOptions : SessionCommandOptions {
  bool dry_run = false, fresh = false;  // of a room, as for run
  double budget_s = kFitBudgetS;
};
// Estimates the albedo of a room (after all stages of RunCommand), or of an object by photometric stereo.
// Writes OUT/result.json and the files of apps/stages/albedo/stage_albedo.h and apps/stages/albedo/stage_stereo.h.
int AlbedoCommand(const AlbedoCommandOptions& options);

struct CheckCommandOptions {
  std::string out;     // folder of an earlier run
  std::string subset;  // pattern of readings with a row of its own; empty: none
  bool json = false;
};
// Reads OUT/result.json.
int CheckCommand(const CheckCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_COMMANDS_H_
