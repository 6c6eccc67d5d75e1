#include "forward/luminaire/distribution_ops.h"

#include <algorithm>

#include "forward/luminaire/internal/distribution_rows.h"
#include "forward/luminaire/photometry.h"

namespace luxfit {
namespace {

Intensity OnePlaneIntensity(const Luminaire& luminaire, double cosine_gamma) {
  const PlaneIntensity intensity = IntensityInOnePlane(*luminaire.table, cosine_gamma);
  return {intensity.cd_per_lm, intensity.d_cosine, 0};
}

}  // namespace

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

IntensityAboutAim AboutAimOf(const Luminaire& luminaire) {
  const DistributionOps& ops = OpsOf(luminaire.distribution);
  const bool is_plane = ops.has_table && luminaire.table && IsOnePlaneAboutAim(*luminaire.table);
  return is_plane ? OnePlaneIntensity : ops.about_aim;
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
