#include "calib/luminance/weighted_median.h"

#include <algorithm>
#include <cmath>

namespace luxfit {

double WeightedMedian(std::vector<std::pair<double, double>> value_and_weight) {
  std::sort(value_and_weight.begin(), value_and_weight.end());
  double total = 0, below = 0;
  for (const auto& [value, weight] : value_and_weight) total += weight;
  for (const auto& [value, weight] : value_and_weight) {
    below += weight;
    if (below >= total / 2) return value;
  }
  return std::nan("");
}

}  // namespace luxfit
