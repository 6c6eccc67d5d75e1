// A session up to its observations: what a fit starts from, and those who fit again and again (charts).
//
//   linearize -> register -> observe, each kept in OUT/stages/ (apps/stages/stage_cache.h) and run again only where
//   something that it depends on has changed
//
// What a refit changes afterwards is the room, the observations or the readings. Throws as the stages do
// (apps/stages/stages.h), and where a session with a room has poses in another frame than the mesh's.
#ifndef LUXFIT_APPS_STAGES_PREPARED_SESSION_H_
#define LUXFIT_APPS_STAGES_PREPARED_SESSION_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/stages/stage_inputs.h"
#include "apps/stages/stages.h"
#include "inverse/study/stability_score.h"

namespace luxfit {

struct PreparedSession {
  Session session;  // linearized
  Room room;
  RegisteredSession registered;
  std::vector<Observation> observations;  // of every view, not thinned
  std::vector<SeenPlace> seen;            // where luminaires show
};
// `inputs` are those of the session as it was read (InputsOfStages).
PreparedSession PrepareSession(Session session, const SessionInputs& inputs, RunContext& context);
PreparedSession PrepareSession(const Session& session, RunContext& context);

// The first stages alone.
Session LinearizeKept(Session session, const SessionInputs& inputs, RunContext& context);
RegisteredSession RegisterKept(const Session& linearized, const SessionInputs& inputs, RunContext& context);

// A fit of the session in that state, by all that `luxfit fit` does, without progress lines. Throws as
// FitSession does.
struct Refit {
  RoomFit fit;
  std::vector<EstimatedLuminaire> luminaires;  // those found; flux relative where no scale is known
  std::vector<std::string> warnings;           // codes
  bool undetermined = false;                   // exit status 1
  double mean_lux_error_percent = 0;           // of the readings that only check; NaN: there are none
};
Refit RefitSession(const Session& session, const Room& room, const SessionObservations& observed,
                   const RunContext& context);

// True luminaires from a JSON file {"lamps": [{"id", "position", "flux_lm"}, ...]}, as that of
// fixtures/office. Throws std::runtime_error naming the file where it is of another form.
std::vector<EstimatedLuminaire> ReadTruth(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_PREPARED_SESSION_H_
