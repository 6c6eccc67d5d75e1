// Hashes what the outcome of each stage depends on: every part of a session, under a name that a user
// understands.
//
//   linearize   cameras, photos
//   register    cameras, tags, mesh, the photos it looks at (all of them where a camera's response or
//               brackets tie photos together)
//   observe     both, states (and the boxes that were found: apps/stages/prepared_session.cc)
//   furniture   the same as observe, and readings, for no solid is where a meter stood
//   result      everything, readings and luminaires too
//
// Files count by path and content, and tables of the session file by their keys and values (not by comments
// or layout). The program counts by its own bytes: another build repeats everything.
#ifndef LUXFIT_APPS_STAGES_STAGE_INPUTS_H_
#define LUXFIT_APPS_STAGES_STAGE_INPUTS_H_

#include <map>
#include <string>
#include <vector>

#include "apps/session/session.h"

namespace luxfit {

using StageInputs = std::map<std::string, std::string>;

struct SessionInputs {
  StageInputs linearize, registration, observe, furniture, result;
};
// Returns the inputs of a session as ReadSession gives it. `earlier_luminaires` is the path of a result.json;
// empty: none.
SessionInputs InputsOfStages(const Session& session, const std::string& earlier_luminaires);

// Return the session without the parts that the stage's inputs do not name, so that the stage cannot depend
// on them.
Session ForRegistration(Session session);
Session ForObservation(Session session);

// Returns the names that only one of the two has, or whose hashes differ, sorted.
std::vector<std::string> ChangedInputs(const StageInputs& before, const StageInputs& now);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_STAGE_INPUTS_H_
