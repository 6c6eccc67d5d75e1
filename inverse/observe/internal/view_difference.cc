#include "inverse/observe/internal/view_difference.h"

#include <cmath>

namespace luxfit {

ViewDifference DifferenceOf(const ViewTable& table, int a, int b) {
  ViewDifference difference;
  const Eigen::ArrayXd value = table.log_luminance.col(a) - table.log_luminance.col(b);
  difference.value.resize(value.size());
  difference.noise.resize(value.size());
  for (Eigen::Index s = 0; s < value.size(); ++s) {
    if (!std::isfinite(value[s])) continue;
    difference.value[difference.states] = value[s];
    difference.noise[difference.states] = table.variance(s, a) + table.variance(s, b);
    ++difference.states;
  }
  const int n = difference.states;
  difference.value.conservativeResize(n);
  difference.noise.conservativeResize(n);
  if (n == 0) return difference;
  difference.common = difference.value.mean();
  difference.common_noise = difference.noise.sum() / (static_cast<double>(n) * n);
  return difference;
}

double LogDensity(const ViewDifference& difference, double common_variance, double state_variance) {
  // Sherman and Morrison, and the determinant of a diagonal and one dyad.
  const Eigen::ArrayXd weight = 1 / (difference.noise + state_variance);
  const double sum = weight.sum(), weighed = (weight * difference.value).sum();
  const double dyad = 1 + common_variance * sum;
  const double squares =
      (weight * difference.value.square()).sum() - common_variance * weighed * weighed / dyad;
  return -0.5 * (squares + std::log(dyad) - weight.log().sum());
}

}  // namespace luxfit
