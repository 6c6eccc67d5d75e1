// What the outcome of each stage depends on: a hash for every part of a session, by a name that a user
// understands.
//
//   linearize   cameras, photos
//   register    cameras, tags, mesh, the photos it looks at (all of them where a camera's response or
//               brackets tie photos together)
//   observe     both, states
//   result      everything, readings and luminaires too
//
// Files count by path and content, tables of the session file by their keys and values (not by comments or
// layout), and the program by its own bytes: another build redoes everything.
#ifndef LUXFIT_APPS_STAGES_STAGE_INPUTS_H_
#define LUXFIT_APPS_STAGES_STAGE_INPUTS_H_

#include <map>
#include <string>
#include <vector>

#include "apps/session/session.h"

namespace luxfit {

using StageInputs = std::map<std::string, std::string>;

struct SessionInputs {
  StageInputs linearize, registration, observe, result;
};
// Of a session as ReadSession gives it. `earlier_luminaires`: path of a result.json, empty: none.
SessionInputs InputsOfStages(const Session& session, const std::string& earlier_luminaires);

// The session without what that stage's inputs do not name, so that it cannot depend on it.
Session ForRegistration(Session session);
Session ForObservation(Session session);

// Names that are in one of the two only, or differ: sorted.
std::vector<std::string> ChangedInputs(const StageInputs& before, const StageInputs& now);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_STAGE_INPUTS_H_
