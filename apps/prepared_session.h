// A session up to its observations, for those who fit it again and again: charts of the whole fit.
//
// The photos are registered and observed once; what a refit changes afterwards is the room, the observations
// or the readings. Throws as the stages do (apps/stages.h).
#ifndef LUXFIT_APPS_PREPARED_SESSION_H_
#define LUXFIT_APPS_PREPARED_SESSION_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/stages.h"
#include "inverse/stability_score.h"

namespace luxfit {

struct PreparedSession {
  Session session;  // linearized
  Room room;
  RegisteredSession registered;
  std::vector<Observation> observations;  // of every view, not thinned
  std::vector<SeenPlace> seen;            // where luminaires show
};
PreparedSession PrepareSession(Session session, RunContext& context);

// A fit of the session in that state, by all that `luxfit fit` does, without progress lines. Throws as
// FitSession does.
struct Refit {
  SessionFit fit;
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

#endif  // LUXFIT_APPS_PREPARED_SESSION_H_
