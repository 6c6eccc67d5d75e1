#include <cmath>

#include "forward/luminaire/internal/distribution_rows.h"

namespace luxfit {
namespace {

Intensity IsotropicIntensity(const Luminaire&, double) { return {1 / (4 * M_PI), 0, 0}; }

}  // namespace

DistributionOps IsotropicDistribution() {
  DistributionOps ops;
  ops.distribution = Distribution::kIsotropic;
  ops.name = "isotropic";
  ops.photometry = "isotropic";
  ops.has_aim = false;
  ops.is_tried = true;
  ops.last_gamma_deg = 180;
  ops.about_aim = IsotropicIntensity;
  ops.towards = TowardsAboutAim<IsotropicIntensity>;
  ops.is_symmetric_about_aim = [](const Luminaire&) { return true; };
  ops.shines_to_one_side = [](const Luminaire&) { return false; };
  ops.sharpness = [](const Luminaire&) { return 1.0; };
  ops.missing = [](const Luminaire&) -> const char* { return nullptr; };
  return ops;
}

}  // namespace luxfit
