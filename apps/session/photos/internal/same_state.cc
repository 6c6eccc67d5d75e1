#include "apps/session/photos/internal/same_state.h"

#include <algorithm>
#include <cmath>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr size_t kFewestPixels = 100;
constexpr float kDarkest = 0.002f;  // of full scale: 8-bit counts below 6 are mostly rounding
constexpr double kSameSpread = 0.1, kSameStrength = 0.25, kSteepest = 0.5;
constexpr double kDoubtful = 0.6;  // of a limit

double SpreadOf(const std::vector<double>& values) {
  const double middle = Median(values);
  std::vector<double> deviations;
  deviations.reserve(values.size());
  for (const double value : values) deviations.push_back(std::abs(value - middle));
  return kSigmaPerMad * Median(deviations);
}

bool IsSame(const LightComparison& light, double share) {
  return light.spread < share * kSameSpread && std::abs(light.slope) < kSteepest &&
         std::abs(light.strength.value_or(0)) < share * kSameStrength;
}

}  // namespace

std::optional<LightComparison> CompareLight(const PhotoLook& a, const PhotoLook& b) {
  if (a.pattern.rows() != b.pattern.rows() || a.pattern.cols() != b.pattern.cols()) return std::nullopt;
  std::vector<double> differences, levels;
  for (Eigen::Index i = 0; i < a.pattern.size(); ++i) {
    const float x = a.pattern.data()[i], y = b.pattern.data()[i];
    if (!(x > kDarkest) || !(y > kDarkest)) continue;
    differences.push_back(std::log(static_cast<double>(x) / y));
    levels.push_back(0.5 * std::log(static_cast<double>(x) * y));
  }
  if (differences.size() < kFewestPixels) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(differences.size());
  const Eigen::Map<Eigen::ArrayXd> d(differences.data(), count), l(levels.data(), count);
  LightComparison light;
  const double variance = (l - l.mean()).square().sum();
  light.slope = variance > 0 ? ((l - l.mean()) * (d - d.mean())).sum() / variance : 0;
  const double level = Median(differences);
  const double middle = l.mean();
  for (size_t i = 0; i < differences.size(); ++i) differences[i] -= light.slope * (levels[i] - middle);
  light.spread = SpreadOf(differences);
  const auto exposure_a = a.RelativeExposure(), exposure_b = b.RelativeExposure();
  if (exposure_a && exposure_b) light.strength = level - std::log(*exposure_a / *exposure_b);
  return light;
}

std::vector<StateOfPhoto> GroupByLight(const std::vector<const PhotoLook*>& photos) {
  std::vector<StateOfPhoto> states(photos.size());
  int count = 0;
  for (size_t i = 0; i < photos.size(); ++i) {
    int same = -1;
    for (size_t j = 0; j < i; ++j) {
      const auto light = CompareLight(*photos[i], *photos[j]);
      if (!light || !IsSame(*light, 1 / kDoubtful)) continue;
      const bool is_same = IsSame(*light, 1);
      if (!IsSame(*light, kDoubtful)) states[i].is_doubtful = true;
      if (is_same && same < 0) same = states[j].state;
    }
    states[i].state = same >= 0 ? same : count++;
  }
  return states;
}

}  // namespace luxfit
