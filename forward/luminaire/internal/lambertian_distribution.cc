#include <cmath>

#include "forward/luminaire/internal/distribution_rows.h"

namespace luxfit {
namespace {

Intensity LambertianIntensity(const Luminaire&, double cosine_gamma) {
  if (cosine_gamma <= 0) return {};
  return {cosine_gamma / M_PI, 1 / M_PI, 0};
}

}  // namespace

DistributionOps LambertianDistribution() {
  DistributionOps ops;
  ops.distribution = Distribution::kLambertian;
  ops.name = "lambertian";
  ops.photometry = "lambertian";
  ops.is_tried = true;
  ops.is_diffuse = true;
  ops.about_aim = LambertianIntensity;
  ops.towards = TowardsAboutAim<LambertianIntensity>;
  ops.is_symmetric_about_aim = [](const Luminaire&) { return true; };
  ops.shines_to_one_side = [](const Luminaire&) { return true; };
  ops.sharpness = [](const Luminaire&) { return 1.0; };
  ops.missing = [](const Luminaire&) -> const char* { return nullptr; };
  return ops;
}

}  // namespace luxfit
