// Decides whether light is exchanged between surfaces in three channels or as luminance alone.
//
// Between coloured surfaces, the luminance of reflected light is not the product of luminances: it is 1 % more
// between a desk of wood and a warm floor. The fit is repeated with the materials' tints
// (LightState::tint). They stay where that moves a parameter by more than a tenth of its sigma; a smaller
// effect is not worth three solves.
//
// Luminaires count as neutral.
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_CHOOSE_COLOUR_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_CHOOSE_COLOUR_H_

#include <vector>

#include "inverse/model/fit_luminaires.h"

namespace luxfit {

struct ColourChoice {
  LuminaireFit fit;          // with tints where they are used
  bool is_compared = false;  // false: no photos, or all surfaces are grey
  bool is_used = false;
  double effect_sigmas = 0;  // of the parameter that moves most
  ParameterId moved_most = {};
};

// `fit` to `data` needs its covariance. `albedo_rgb`: by material, in any unit; NaN counts as grey.
ColourChoice ChooseColour(const Room& room, const LightData& data, const LuminaireFit& fit,
                          const Eigen::Matrix3Xd& albedo_rgb, const std::vector<ParameterPrior>& priors);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_CHOOSE_COLOUR_H_
