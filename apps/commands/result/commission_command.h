// Runs `luxfit commission OUT --design FILE`: compares what was fitted with what was designed, and finds the
// dimming levels that reach the targets at the least power.
//
// Writes commission.json, luminaires.csv (differences with 95 % intervals, verdicts) and, with targets,
// levels.csv and targets.csv. docs/commands.md describes the files and the design's keys.
//
// Returns the exit status: 1 where the targets cannot be reached. Throws std::runtime_error for bad input.
#ifndef LUXFIT_APPS_COMMANDS_RESULT_COMMISSION_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_RESULT_COMMISSION_COMMAND_H_

#include <string>

namespace luxfit {

struct CommissionCommandOptions {
  std::string out;              // folder of the run
  std::string design;           // TOML; empty: no comparison
  std::string targets;          // TOML of areas (docs/report.md, "Targets"); empty: the design's points alone
  std::string session, folder;  // folder empty: OUT/commission
  std::string command_line;
  bool json = false;
};

int CommissionCommand(const CommissionCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_RESULT_COMMISSION_COMMAND_H_
