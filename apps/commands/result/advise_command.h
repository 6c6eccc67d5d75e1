// Runs `luxfit advise OUT`: ranks photos and readings to come by how much they would shrink the uncertainty of what
// is asked for (inverse/advise/advise.h).
//
// Writes OUT/advise.json and OUT/advise.svg, a plan of the room with the advice. docs/advise.md describes them.
//
// Returns the exit status: 1 where something asked for is not determined and no candidate determines it. Throws
// std::runtime_error for bad input, and for a room so large that its light has no derivatives.
#ifndef LUXFIT_APPS_COMMANDS_RESULT_ADVISE_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_RESULT_ADVISE_COMMAND_H_

#include <string>

namespace luxfit {

struct AdviseCommandOptions {
  std::string out;      // folder of the run
  std::string session;  // replaces the one that the result names
  std::string of;       // flux | position | readings | id of a luminaire; empty: flux and position
  std::string only;     // photos | readings; empty: both
  int top = 5;
  std::string photo_table, reading_table;  // tables of candidates (apps/commands/internal/advice_given.h)
  std::string plan;                        // path of the picture; empty: OUT/advise.svg
  std::string command_line;
  bool json = false;
};

int AdviseCommand(const AdviseCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_RESULT_ADVISE_COMMAND_H_
