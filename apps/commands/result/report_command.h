// Runs `luxfit report OUT`: makes one self-contained HTML page of an earlier run (apps/report/report.h), or
// of a calibration (apps/report/calibration/calibration_report.h) where OUT holds no room.
//
// Prints its path and the statistics of its areas, or whether the calibration can be used, as JSON on
// request. Throws std::runtime_error for an OUT with neither, and for targets or a state that cannot be read
// (exit status 2).
#ifndef LUXFIT_APPS_COMMANDS_RESULT_REPORT_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_RESULT_REPORT_COMMAND_H_

#include <string>

namespace luxfit {

struct ReportCommandOptions {
  std::string out;      // folder of an earlier run
  std::string session;  // replaces the one that result.json names; empty: that one
  std::string targets;  // TOML of areas and observers; empty: the floor against office work
  std::string state;    // shown first; empty: the brightest
  std::string command_line;
  bool json = false;
};

int ReportCommand(const ReportCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_RESULT_REPORT_COMMAND_H_
