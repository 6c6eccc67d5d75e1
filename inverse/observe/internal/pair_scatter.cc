#include "inverse/observe/internal/pair_scatter.h"

namespace luxfit {
namespace {

// Returns whether s is at least the one whose pairs are spread as a Gaussian's.
bool IsWideEnough(const std::vector<ScatterPair>& pairs, double s) {
  constexpr double kInner = 0.6745, kOuter = 2.5;  // half and 98.76 % of a Gaussian
  constexpr double kInnerShare = 0.5 / 0.98758;
  double inner = 0, outer = 0;
  for (const ScatterPair& pair : pairs) {
    const double variance = pair.noise_variance + 2 * s * s;
    if (pair.squared_difference <= kInner * kInner * variance) inner += pair.weight;
    if (pair.squared_difference <= kOuter * kOuter * variance) outer += pair.weight;
  }
  return outer > 0 && inner >= kInnerShare * outer;
}

}  // namespace

double ComponentOf(const std::vector<ScatterPair>& pairs) {
  // Halving comes from above, where all pairs lie within the limits. Far below the solution few do, and by
  // chance.
  double low = 0, high = 1;
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (low + high);
    (IsWideEnough(pairs, middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace luxfit
