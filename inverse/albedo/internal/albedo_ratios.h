// Ratios of measured exitance to incident light: one an observation (inverse/albedo/patch_albedo.h).
#ifndef LUXFIT_INVERSE_ALBEDO_INTERNAL_ALBEDO_RATIOS_H_
#define LUXFIT_INVERSE_ALBEDO_INTERNAL_ALBEDO_RATIOS_H_

#include <vector>

#include "inverse/albedo/patch_albedo.h"

namespace luxfit {

struct AlbedoRatio {
  int element = 0, patch = 0, facet = 0, material = 0, state = 0;
  double value = 0;           // albedo, by this observation alone
  double relative_noise = 0;  // of the photo
};

// Observations in the light of at least one luminaire that no shadow edge crosses.
std::vector<AlbedoRatio> AlbedoRatios(const Room& room, const LightData& data, const LightState& light,
                                      bool interreflection);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_INTERNAL_ALBEDO_RATIOS_H_
