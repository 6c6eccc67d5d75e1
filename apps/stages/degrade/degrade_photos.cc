#include <nlohmann/json.hpp>

#include "apps/stages/degrade/degradation_rows.h"
#include "apps/stages/observe/observed_light.h"
#include "inverse/study/degrade.h"

namespace luxfit {
namespace {

std::optional<std::string> NeedsPhotos(const UndegradedSession& whole) {
  if (whole.thinned.empty()) return "the session has no photos";
  return std::nullopt;
}

std::optional<std::string> NeedsTwoViews(const UndegradedSession& whole) {
  if (CountViews(whole.thinned) < 2) return "fewer than two views are observed";
  return std::nullopt;
}

std::optional<std::string> NeedsTwoStates(const UndegradedSession& whole) {
  if (CountStates(whole.thinned) < 2) return "fewer than two states are observed";
  return std::nullopt;
}

void AddNoise(UndegradedSession& whole, double percent, std::mt19937_64& rng, DegradedCase& c) {
  c.observations = WithPixelNoise(whole.thinned, percent / 100, rng);
}

void FalsifyExposures(UndegradedSession& whole, double percent, std::mt19937_64& rng, DegradedCase& c) {
  nlohmann::json unused;
  c.observations = WithSelfCalibration(
      c.session, c.linearized.photos, whole.prepared.registered, whole.prepared.room.patches,
      WithExposureErrors(whole.thinned, percent / 100, rng), c.context, unused);
}

void DropViews(UndegradedSession& whole, double percent, std::mt19937_64& rng, DegradedCase& c) {
  c.observations = WithoutViews(whole.thinned, ShareOf(percent, CountViews(whole.thinned), 1), rng);
}

void DropStates(UndegradedSession& whole, double percent, std::mt19937_64& rng, DegradedCase& c) {
  c.observations = WithoutStates(whole.thinned, ShareOf(percent, CountStates(whole.thinned), 1), rng);
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
