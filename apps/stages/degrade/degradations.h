// Makes a session worse in every way of `luxfit chart --stability`, level by level, and fits it again.
//
//   noise                 of each pixel, % of its value; added to the means of the observations
//   exposure              error of each photo's exposure, % (one sigma)
//   views_dropped         % of the views
//   states_dropped        % of the states
//   tags_moved            error of each surveyed tag's place along each axis, mm (one sigma); views are
//                         registered and observed again
//   faces_removed         % of the furniture missing from the mesh
//   luminaires_together   the nearest two luminaires are that far apart, m      (simulated)
//   albedo_raised         % of the way from each reflectance to 0.95            (simulated)
//
// The last two are simulated, because no photos show them. The unbiased light tracer
// (inverse/study/simulated_light.h) traces the light of the reference's luminaires in the session's mesh. It
// shares no patch and no form factor with the model that is fitted, and adds 1 % of model error by facet and
// state. The reference is then what was simulated. One trial draws the same random numbers at every level, so
// that levels compare.
//
// Throws std::runtime_error for unknown names.
#ifndef LUXFIT_APPS_STAGES_DEGRADE_DEGRADATIONS_H_
#define LUXFIT_APPS_STAGES_DEGRADE_DEGRADATIONS_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/stages/degrade/degradation.h"

namespace luxfit {

const std::vector<Degradation>& AllDegradations();
// Returns those named, in their own order; all of them where no name is given.
std::vector<Degradation> DegradationsNamed(const std::vector<std::string>& names);

// One degraded session, fitted.
struct DegradedFit {
  FitScore score;
  Refit refit;
  bool failed = false;                    // nothing could be fitted
  std::string message;                    // why
  double seconds = 0;                     // with everything that was done again
  std::vector<std::string> new_warnings;  // codes that the undegraded session has not
};

class DegradedSessions {
 public:
  // Keeps a reference to `prepared`. `truth`: of the luminaires; empty: the undegraded fit. `max_elements`:
  // observed elements used by every fit, the undegraded one too. Fits the undegraded session.
  DegradedSessions(const PreparedSession& prepared, std::vector<EstimatedLuminaire> truth, int max_elements,
                   uint64_t seed, RunContext& context);

  const Refit& undegraded() const { return whole_.refit; }
  const FitScore& undegraded_score() const { return undegraded_score_; }
  // Says why this session does not allow the degradation; nothing where it does.
  std::optional<std::string> WhyNot(const Degradation& degradation) const;
  DegradedFit Fit(const Degradation& degradation, double level, int trial);

 private:
  UndegradedSession whole_;
  uint64_t seed_;
  RunContext& context_;
  FitScore undegraded_score_;
  std::vector<std::string> known_warnings_;
};

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_DEGRADE_DEGRADATIONS_H_
