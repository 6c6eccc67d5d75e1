// Makes the rows of the table of distributions, one function and one file each.
#ifndef LUXFIT_FORWARD_LUMINAIRE_INTERNAL_DISTRIBUTION_ROWS_H_
#define LUXFIT_FORWARD_LUMINAIRE_INTERNAL_DISTRIBUTION_ROWS_H_

#include "forward/luminaire/distribution_ops.h"

namespace luxfit {

DistributionOps IsotropicDistribution();
DistributionOps LambertianDistribution();
DistributionOps CosinePowerDistribution();
DistributionOps MeasuredDistribution();

// `towards` of a distribution that is the same all round its aim: one call, with its `about_aim` inlined.
template <Intensity (*about_aim)(const Luminaire&, double)>
DirectedIntensity TowardsAboutAim(const Luminaire& luminaire, const LuminaireAxes&,
                                  const Eigen::Vector3d& direction) {
  const Intensity intensity = about_aim(luminaire, luminaire.aim.dot(direction));
  return {intensity.cd_per_lm, intensity.d_cosine * luminaire.aim, intensity.d_exponent};
}

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_INTERNAL_DISTRIBUTION_ROWS_H_
