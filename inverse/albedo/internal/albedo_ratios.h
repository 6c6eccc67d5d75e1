// Computes the ratio of measured exitance to incident light, one for each observation.
//
// Equations are in inverse/albedo/patch_albedo.h. Ratios are albedos, dimensionless.
#ifndef LUXFIT_INVERSE_ALBEDO_INTERNAL_ALBEDO_RATIOS_H_
#define LUXFIT_INVERSE_ALBEDO_INTERNAL_ALBEDO_RATIOS_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/albedo/patch_albedo.h"

namespace luxfit {

struct AlbedoRatio {
  int element = 0, patch = 0, facet = 0, material = 0, state = 0;
  double value = 0;                               // albedo, by this observation alone
  double relative_noise = 0;                      // noise of the photo
  Eigen::Vector3d rgb = Eigen::Vector3d::Zero();  // of ColourRatios: the same by channel
};

// Returns ratios of the observations that at least one luminaire lights and no shadow edge crosses.
std::vector<AlbedoRatio> AlbedoRatios(const Room& room, const LightData& data, const LightState& light,
                                      bool interreflection);

// Returns the same with the ratios of red, green and blue, in light that is neutral. NaN: an observation without colour.
std::vector<AlbedoRatio> ColourRatios(const Room& room, const LightData& data, const LightState& light);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_INTERNAL_ALBEDO_RATIOS_H_
