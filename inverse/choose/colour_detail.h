// Whether materials have a colour, and whether luminaires differ in theirs.
//
//   Y_c = rho_c (I_c + t_ck (Y / rho - I)),     c: red, green, blue
//
// Y, Y_c: luminance and channel of an observation; I, I_c: indirect light as measured in each
// (inverse/model/measured_indirect.h); so Y / rho - I is the direct light, whatever the luminaires are, and every
// error that luminance and channels share cancels. grey: rho_c = rho; coloured: rho_c free, one a material
// and channel. t: tint of luminaire k, 1 or free; free where two luminaires or more are seen one by one.
//
// Fitted to four fifths of the patches and scored on the fifth left out: the mean of min(z^2, 9) over the
// channels. A material is coloured, and luminaires are unlike, where the simpler model is not within one
// standard error of it. Assumes, as inverse/albedo/albedo_rgb.h, luminaires that are neutral in the camera's RGB
// where they are alike. Source: one-standard-error rule: Breiman et al. (1984), sec. 3.4.
#ifndef LUXFIT_INVERSE_CHOOSE_COLOUR_DETAIL_H_
#define LUXFIT_INVERSE_CHOOSE_COLOUR_DETAIL_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/select/detail_choice.h"

namespace luxfit {

struct ColourDetail {
  // By material: grey, coloured; empty where its reflectance was held, or too little of it is seen.
  std::vector<DetailChoice> materials;
  DetailChoice luminaires;  // alike, each its own; empty where fewer than two are seen one by one
  Eigen::Matrix3Xd tint;    // by luminaire, relative to their mean; NaN where not seen alone
};

// `fit` to `data`.
ColourDetail CompareColours(const Room& room, const LightData& data, const LuminaireFit& fit);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_COLOUR_DETAIL_H_
