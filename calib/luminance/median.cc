#include "calib/luminance/median.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace luxfit {

double Median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

double Quantile(std::vector<double> values, double share) {
  if (!(share >= 0 && share <= 1)) throw std::invalid_argument("Quantile: expected a share in [0, 1]");
  if (values.empty()) return std::nan("");
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size()));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace luxfit
