// Runs `luxfit advise OUT|SESSION`: ranks photos and readings to come by how much they would shrink the uncertainty of
// what is asked for (inverse/advise/advise.h).
//
// Writes advise.json and advise.svg, a plan of the room with the advice, into the folder of the run, or of a session
// without a run into the one that is named. docs/advise.md describes them.
//
// Returns the exit status: 1 where something asked for is not determined and no candidate determines it. Throws
// std::runtime_error for bad input, and for a room so large that its light has no derivatives.
#ifndef LUXFIT_APPS_COMMANDS_RESULT_ADVISE_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_RESULT_ADVISE_COMMAND_H_

#include <string>

namespace luxfit {

struct AdviseCommandOptions {
  std::string input;    // folder of a run, or its result.json; or a session file, or its folder
  std::string out;      // folder to write into; empty: that of the run; of a session, none
  std::string session;  // replaces the one that the result names
  std::string of;       // flux | position | readings | id of a luminaire; empty: flux and position
  std::string only;     // photos | readings; empty: both
  int top = 0;          // 0: 5 of a run, 12 of a session
  std::string photo_table,
      reading_table;  // tables of candidates (apps/commands/internal/advise/advice_given.h)
  std::string plan;   // path of the picture; empty: advise.svg in `out`
  std::string command_line;
  bool json = false;
};

int AdviseCommand(const AdviseCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_RESULT_ADVISE_COMMAND_H_
