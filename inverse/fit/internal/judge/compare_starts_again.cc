#include "inverse/fit/internal/judge/compare_starts_again.h"

#include <algorithm>
#include <utility>

#include "inverse/fit/internal/surface_texture.h"
#include "inverse/model/internal/measured_indirect.h"

namespace luxfit {
namespace {

// Returns the fit with what types have in common held.
LightState WithTypesHeld(LightState state) {
  for (const std::vector<int>& type : TypesOf(state)) {
    for (const int k : type) {
      if (type.size() < 2) continue;
      FreeQuantities& free = state.free[static_cast<size_t>(k)];
      free.exponent = free.size = false;
      free.table_sigma = free.emission_sigma = 0;
    }
  }
  return state;
}

}  // namespace

void CompareStartsAgain(const Room& room, const LightData& data, const LuminaireFit& fit,
                        const std::vector<ParameterPrior>& priors, const std::set<int>& settled,
                        std::vector<StartComparison>& starts) {
  const LightState state = WithTypesHeld(fit.state);
  std::vector<std::vector<Luminaire>> rivals(state.luminaires.size());
  for (const StartComparison& c : starts) {
    if (settled.count(c.luminaire) > 0) continue;
    for (const int rival : c.rivals)
      rivals[static_cast<size_t>(c.luminaire)].push_back(c.end[static_cast<size_t>(rival)]);
  }
  const bool has_any = std::any_of(rivals.begin(), rivals.end(), [](const auto& r) { return !r.empty(); });
  if (!has_any || data.observations.empty()) return;
  const LightData held = WithoutTexture(room, WithModelledIndirect(room, data, fit.state), fit, priors);
  SeveralStarts again = FitFromSeveralStarts(room, held, state, rivals, priors);
  for (StartComparison& c : again.comparisons) {
    const auto before = std::find_if(starts.begin(), starts.end(),
                                     [&](const StartComparison& s) { return s.luminaire == c.luminaire; });
    if (c.chosen == 0) *before = std::move(c);
  }
}

}  // namespace luxfit
