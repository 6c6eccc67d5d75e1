#include "forward/luminaire/distribution_ops.h"

#include <algorithm>

#include "forward/luminaire/internal/distribution_rows.h"

namespace luxfit {

const std::array<DistributionOps, 4>& Distributions() {
  static const std::array<DistributionOps, 4> distributions = {
      IsotropicDistribution(),
      LambertianDistribution(),
      CosinePowerDistribution(),
      MeasuredDistribution(),
  };
  return distributions;
}

// By its place, not by search: some callers ask once a ray.
const DistributionOps& OpsOf(Distribution distribution) {
  return Distributions()[static_cast<size_t>(distribution)];
}

const DistributionOps* FindDistribution(const std::string& photometry) {
  const auto& rows = Distributions();
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const DistributionOps& ops) { return ops.photometry == photometry; });
  return found == rows.end() ? nullptr : &*found;
}

std::vector<std::string> PhotometryNames(bool (*holds)(const DistributionOps&)) {
  std::vector<std::string> names;
  for (const DistributionOps& ops : Distributions()) {
    if (holds == nullptr || holds(ops)) names.emplace_back(ops.photometry);
  }
  return names;
}

}  // namespace luxfit
