// Prepares a session up to its observations, for a fit, or for many fits of the same session (charts).
//
//   linearize -> register -> furniture -> observe
//
// Each stage is kept in OUT/stages/ (apps/stages/stage_cache.h) and runs again only where something that it
// depends on has changed.
//
// A refit may then change the session, the room, the observations or the readings. Throws as the stages do
// (apps/stages/stages.h), and where a session with a room has poses in another frame than the mesh's.
#ifndef LUXFIT_APPS_STAGES_PREPARED_SESSION_H_
#define LUXFIT_APPS_STAGES_PREPARED_SESSION_H_

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "apps/stages/stage_inputs.h"
#include "apps/stages/stages.h"
#include "inverse/observe/as_if/mesh_as_if.h"
#include "inverse/study/stability_score.h"

namespace luxfit {

struct PreparedSession {
  Session session;  // as it was read, with the furniture that was found
  LinearizedSession linearized;
  Room room;
  RegisteredSession registered;
  std::vector<MeshExplanation> mesh_as_if;  // how the mesh lies otherwise than the room
  Evidence observed;                        // from every view, not thinned
};
// `inputs` are those of the session as it was read (InputsOfStages).
PreparedSession PrepareSession(const Session& session, const SessionInputs& inputs, RunContext& context);
PreparedSession PrepareSession(const Session& session, RunContext& context);

// Observes the registered views again in the photos that `is_kept` names; those of a state with all luminaires
// off are kept in any case. Views keep their numbers.
Evidence ObserveKeptPhotos(const PreparedSession& prepared,
                           const std::function<bool(const LinearizedPhoto&)>& is_kept, RunContext& context);

// Returns the same of at most `max_elements` elements; outlines and places stay.
Evidence Thinned(Evidence observed, int max_elements);

// Runs the first stages alone.
LinearizedSession LinearizeKept(const Session& session, const SessionInputs& inputs, RunContext& context);
RegisteredSession RegisterKept(const Session& session, const LinearizedPhotos& photos,
                               const SessionInputs& inputs, RunContext& context);

// Fits the session in that state with all steps of `luxfit fit`, without progress lines. Throws as FitSession
// does.
struct Refit {
  RoomFit fit;
  std::vector<EstimatedLuminaire> luminaires;  // as found; flux is relative where no scale is known
  std::vector<Warning> warnings;
  bool undetermined = false;          // exit status 1
  double mean_lux_error_percent = 0;  // over the readings that only check; NaN: there are none
};
Refit RefitSession(const Session& session, const LinearizedSession& linearized, const Room& room,
                   const Evidence& observed, const RunContext& context);

// Reads true luminaires from a JSON file {"lamps": [{"id", "position", "flux_lm"}, ...]}, such as that of
// fixtures/office. Throws std::runtime_error naming the file where it has another form.
std::vector<EstimatedLuminaire> ReadTruth(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_PREPARED_SESSION_H_
