#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "apps/stages/degrade/degradation_rows.h"
#include "apps/stages/observe/observed_light.h"
#include "inverse/study/degrade.h"

namespace luxfit {
namespace {

std::optional<std::string> NeedsPhotos(const UndegradedSession& whole) {
  if (whole.observed.observations.empty()) return "the session has no photos";
  return std::nullopt;
}

std::optional<std::string> NeedsTwoViews(const UndegradedSession& whole) {
  if (CountViews(whole.observed.observations) < 2) return "fewer than two views are observed";
  return std::nullopt;
}

std::optional<std::string> NeedsTwoStates(const UndegradedSession& whole) {
  if (CountStates(whole.observed.observations) < 2) return "fewer than two states are observed";
  return std::nullopt;
}

void AddNoise(UndegradedSession& whole, double percent, std::mt19937_64& rng, DegradedCase& c) {
  c.observed.observations = WithPixelNoise(whole.observed.observations, percent / 100, rng);
}

void FalsifyExposures(UndegradedSession& whole, double percent, std::mt19937_64& rng, DegradedCase& c) {
  nlohmann::json unused;
  c.observed.observations = WithSelfCalibration(
      c.session, c.linearized.photos, whole.prepared.registered, whole.prepared.room.patches,
      whole.observed.states_as_if, WithExposureErrors(whole.observed.observations, percent / 100, rng),
      c.context, unused);
}

// Observes the photos again of which some observation is left: what they show of luminaires goes with them.
void KeepPhotosOf(const std::vector<Observation>& left, const UndegradedSession& whole, DegradedCase& c) {
  std::set<std::pair<std::string, std::string>> photos;  // view, state
  for (const Observation& o : left)
    photos.emplace(whole.prepared.registered.registration.views[static_cast<size_t>(o.view)].view,
                   c.session.states[static_cast<size_t>(o.state)].id);
  c.observed = Thinned(ObserveKeptPhotos(
                           whole.prepared,
                           [&](const LinearizedPhoto& p) {
                             return photos.count({p.view, p.state}) > 0;
                           },
                           c.context),
                       whole.max_elements);
}

void DropViews(UndegradedSession& whole, double percent, std::mt19937_64& rng, DegradedCase& c) {
  const std::vector<Observation>& all = whole.observed.observations;
  KeepPhotosOf(WithoutViews(all, ShareOf(percent, CountViews(all), 1), rng), whole, c);
}

void DropStates(UndegradedSession& whole, double percent, std::mt19937_64& rng, DegradedCase& c) {
  const std::vector<Observation>& all = whole.observed.observations;
  KeepPhotosOf(WithoutStates(all, ShareOf(percent, CountStates(all), 1), rng), whole, c);
}

}  // namespace

Degradation PixelNoise() {
  return {"noise",     "%",     "noise of a pixel, % of its value", {2, 10, 30, 100, 300}, true,
          NeedsPhotos, AddNoise};
}

Degradation ExposureErrors() {
  const std::vector<double> levels = {1, 2, 5, 10, 20};
  return {"exposure", "%", "error of each photo's exposure, %", levels, true, NeedsPhotos, FalsifyExposures};
}

Degradation ViewsDropped() {
  return {"views_dropped", "%", "views left out, %", {25, 50, 75, 88}, false, NeedsTwoViews, DropViews};
}

Degradation StatesDropped() {
  return {"states_dropped", "%",       "states left out, %", {17, 33, 50, 67, 83}, false,
          NeedsTwoStates,   DropStates};
}

}  // namespace luxfit
