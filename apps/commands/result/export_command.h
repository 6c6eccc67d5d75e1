// Runs `luxfit export OUT`: writes a fitted room as files of other programs (apps/export/exports.h).
//
// Returns the exit status: 0, or 1 where something that `only` names is not determined. Throws
// std::runtime_error for bad input.
#ifndef LUXFIT_APPS_COMMANDS_RESULT_EXPORT_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_RESULT_EXPORT_COMMAND_H_

#include <string>
#include <vector>

namespace luxfit {

struct ExportCommandOptions {
  std::string out;                // folder of the run
  std::string session;            // replaces the one that the result names
  std::string folder;             // folder to write into; empty: OUT/export
  std::vector<std::string> only;  // names of exports; empty: all
  std::string command_line;
  bool json = false;
};

// Returns the names of the exports in the order in which they are made.
std::vector<std::string> ExportNames();

int ExportCommand(const ExportCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_RESULT_EXPORT_COMMAND_H_
