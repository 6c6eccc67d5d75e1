#include <algorithm>
#include <cmath>

#include "forward/luminaire/internal/distribution_rows.h"

namespace luxfit {
namespace {

Intensity CosinePowerIntensity(const Luminaire& luminaire, double cosine_gamma) {
  if (cosine_gamma <= 0) return {};
  const double m = luminaire.cosine_exponent;
  const double log_cosine = std::log(cosine_gamma);
  const double lobe = std::exp(m * log_cosine) / (2 * M_PI);
  return {(m + 1) * lobe, (m + 1) * m * lobe / cosine_gamma, lobe * (1 + (m + 1) * log_cosine)};
}

const char* MissingExponent(const Luminaire& luminaire) {
  const bool is_valid = luminaire.cosine_exponent > 0 && std::isfinite(luminaire.cosine_exponent);
  return is_valid ? nullptr : "a finite exponent above 0";
}

}  // namespace

DistributionOps CosinePowerDistribution() {
  DistributionOps ops;
  ops.distribution = Distribution::kCosinePower;
  ops.name = "cosine_power";
  ops.photometry = "cosine_power";
  ops.has_exponent = true;
  ops.is_tried = true;
  ops.about_aim = CosinePowerIntensity;
  ops.towards = TowardsAboutAim<CosinePowerIntensity>;
  ops.is_symmetric_about_aim = [](const Luminaire&) { return true; };
  ops.shines_to_one_side = [](const Luminaire&) { return true; };
  ops.sharpness = [](const Luminaire& luminaire) { return std::max(luminaire.cosine_exponent, 1.0); };
  ops.missing = MissingExponent;
  return ops;
}

}  // namespace luxfit
