// Finds which materials have a colour, and whether luminaires differ in theirs.
//
//   Y_c = rho_c (I_c + t_ck (Y / rho - I)),     c: red, green, blue
//
// Y, Y_c: luminance and channel of an observation. I, I_c: indirect light as measured in each
// (inverse/model/internal/measured_indirect.h). Y / rho - I is thus the direct light, whatever the
// luminaires are, and every error that luminance and channels share cancels. Grey: rho_c = rho. Coloured:
// rho_c free, one for each material and channel. t: tint of luminaire k, 1 or free; it is free where at
// least two luminaires are seen one by one.
//
// Neutral surfaces tell the light: l_c = median of (Y_c / rho - I_c) / (t_ck (Y / rho - I)), where direct light exceeds indirect light.
//
// The models are fitted to four fifths of the patches and scored on the fifth left out: the mean of min(z^2,
// 9) over the channels. A material is coloured, and luminaires differ, where the simpler model is not within
// one standard error. Luminaires of one colour are assumed neutral in the camera's RGB, as in
// inverse/albedo/internal/albedo_rgb.h.
//
// Source: Breiman et al. (1984), sec. 3.4 (one-standard-error rule).
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_COLOUR_DETAIL_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_COLOUR_DETAIL_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/select/internal/detail_choice.h"

namespace luxfit {

struct ColourDetail {
  // By material: grey or coloured; empty where its reflectance was held, or too little of it is seen.
  std::vector<DetailChoice> materials;
  DetailChoice luminaires;      // one colour or each its own; empty where fewer than two are seen one by one
  Eigen::Matrix3Xd tint;        // by luminaire, relative to their mean; NaN where not seen alone
  Eigen::Matrix3Xd tint_sigma;  // relative
  // Red, green and blue of the luminaires' mean light over its luminance, and their relative sigmas; NaN where no neutral surface is lit
  // more by luminaires than by other surfaces.
  Eigen::Vector3d neutral_light, neutral_light_sigma;
};

// `fit`: the fit to `data`. `neutral`: materials that reflect red, green and blue alike.
ColourDetail CompareColours(const Room& room, const LightData& data, const LuminaireFit& fit,
                            const std::vector<int>& neutral = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_COLOUR_DETAIL_H_
