// The ways in which `luxfit chart --stability` makes a session worse, level by level, and the refit of one.
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
// The last two cannot be had from photos: the light of the reference's luminaires is traced in the session's
// mesh by the unbiased light tracer (inverse/study/simulated_light.h), which shares no patch and no form factor
// with the model that is fitted to it, with 1 % of model error by facet and state; the reference is then what
// was simulated. One trial draws the same random numbers at every level, so that levels compare.
//
// Throws std::runtime_error for names that there are not.
#ifndef LUXFIT_APPS_STAGES_DEGRADATIONS_H_
#define LUXFIT_APPS_STAGES_DEGRADATIONS_H_

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/stages/prepared_session.h"
#include "apps/stages/view_tags.h"
#include "inverse/study/simulated_light.h"

namespace luxfit {

enum class DegradationKind {
  kNoise,
  kExposure,
  kViewsDropped,
  kStatesDropped,
  kTagsMoved,
  kFacesRemoved,
  kLuminairesTogether,
  kAlbedoRaised
};

struct Degradation {
  DegradationKind kind = DegradationKind::kNoise;
  std::string name, unit, axis;  // axis: of a picture, with the unit
  std::vector<double> levels;    // from harmless to bad
  bool is_log = true;            // how the levels are spaced
};
const std::vector<Degradation>& AllDegradations();
// Those named, in their own order; all where no name is given.
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

  const Refit& undegraded() const { return undegraded_; }
  const FitScore& undegraded_score() const { return undegraded_score_; }
  // Why this one cannot be asked of the session; none where it can.
  std::optional<std::string> WhyNot(const Degradation& degradation) const;
  DegradedFit Fit(const Degradation& degradation, double level, int trial);

 private:
  struct Case;
  Case Degrade(const Degradation& degradation, double level, std::mt19937_64& rng);
  void ObserveWithMovedTags(double sigma_m, std::mt19937_64& rng, Case& c);
  void ObserveWithoutFurniture(double share, std::mt19937_64& rng, Case& c);
  void Simulate(const Degradation& degradation, double level, std::mt19937_64& rng, Case& c);

  const PreparedSession& prepared_;
  int max_elements_;
  uint64_t seed_;
  RunContext& context_;
  std::vector<EstimatedLuminaire> truth_;
  std::vector<Observation> thinned_;
  Refit undegraded_;
  FitScore undegraded_score_;
  std::vector<std::string> known_warnings_;
  std::optional<std::vector<ViewDetections>> detections_;  // of tags, once
  std::map<std::pair<DegradationKind, double>, TracedLight> traced_;
};

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_DEGRADATIONS_H_
