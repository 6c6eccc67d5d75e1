#include "inverse/fit/internal/judge/odd_luminaires.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/fit/internal/outlines.h"
#include "inverse/model/internal/dimming_groups.h"

namespace luxfit {
namespace {

constexpr double kLeftOver = 0.02, kMerged = 10;
constexpr size_t kFewestFellows = 2;

bool IsFluxFitted(const LuminaireFit& fit, int luminaire) {
  return std::any_of(fit.parameters.begin(), fit.parameters.end(),
                     [&](const Parameter& p) { return p.Is(ParameterKind::kLogFlux, luminaire, {}); });
}

bool IsAreaSeen(const LightData& data, int luminaire) {
  return std::any_of(data.outlines.begin(), data.outlines.end(),
                     [&](const LuminaireOutline& outline) { return outline.luminaire == luminaire; });
}

OddLuminaire AgainstFellows(const LuminaireFit& fit, int luminaire, const std::vector<int>& group) {
  OddLuminaire compared{luminaire, {}, false, 1, 1};
  std::vector<double> fluxes;
  double area = 0;
  for (const int k : group) {
    if (k == luminaire) continue;
    compared.fellows.push_back(k);
    fluxes.push_back(fit.state.luminaires[static_cast<size_t>(k)].flux_lm);
    area = std::max(area, OpeningAreaM2(fit.state.luminaires[static_cast<size_t>(k)]));
  }
  const Luminaire& own = fit.state.luminaires[static_cast<size_t>(luminaire)];
  compared.flux_ratio = own.flux_lm / Median(fluxes);
  compared.is_left_over = compared.flux_ratio < kLeftOver;
  if (area > 0) compared.area_ratio = OpeningAreaM2(own) / area;
  return compared;
}

}  // namespace

std::vector<OddLuminaire> FindOddLuminaires(const LuminaireFit& fit, const LightData& data) {
  std::vector<OddLuminaire> odd;
  if (!fit.IsUsable()) return odd;
  for (const LuminaireGroup& group : GroupByDimming(data.dimming).groups) {
    std::vector<int> fitted;
    std::copy_if(group.luminaires.begin(), group.luminaires.end(), std::back_inserter(fitted),
                 [&](int k) { return IsFluxFitted(fit, k); });
    if (fitted.size() <= kFewestFellows) continue;
    for (const int k : fitted) {
      OddLuminaire compared = AgainstFellows(fit, k, fitted);
      const bool is_merged = compared.area_ratio > kMerged && !IsAreaSeen(data, k);
      if (compared.is_left_over || is_merged) odd.push_back(std::move(compared));
    }
  }
  return odd;
}

std::vector<OversizedLuminaire> FindOversizedLuminaires(const LuminaireFit& fit,
                                                        const std::vector<LuminaireOutline>& outlines) {
  std::vector<OversizedLuminaire> oversized;
  if (!fit.IsUsable()) return oversized;
  for (int k = 0; k < static_cast<int>(fit.state.luminaires.size()); ++k) {
    const Luminaire& luminaire = fit.state.luminaires[static_cast<size_t>(k)];
    const double area_m2 = OpeningAreaM2(luminaire), shown_m2 = ShownAreaM2(luminaire, outlines, k);
    if (shown_m2 > 0 && area_m2 > kMostTimesShown * shown_m2) oversized.push_back({k, area_m2, shown_m2});
  }
  return oversized;
}

}  // namespace luxfit
