// How much detail the light of a scene needs: reflections, the size of patches and of elements.
//
// Asked at the fitted state, with no further fit. What a coarser model would predict is the fit's own
// prediction less what it would leave out:
//
//   n reflections             F (M - M_n),  M_n = sum_{k < n} (rho F)^k rho D     M: exitance, D: direct light
//   patches twice as large    F (M - mean of M over 2 x 2 patches)
//   elements twice as large   E - mean of E over 2 x 2 elements
//
// Reflectances that are free may adapt: each material gets the factor with which the coarser prediction fits
// four fifths of the patches; scored is the fifth left out, by the mean of min(z^2, 9). The simplest within
// one standard error of the best is what the photos need. D is sampled at three elements a patch.
//
// What the sizes in use still leave out: a third of the change from twice the size (an error of second order
// in the size), relative, robust (1.48 times the median). It should be below half of the fit's own model
// error, or below 0.5 %.
//
// Nothing is compared without photos or a usable fit.
// Source: one-standard-error rule: Breiman et al. (1984), sec. 3.4; a third: Richardson (1911).
#ifndef LUXFIT_INVERSE_CHOOSE_SCENE_DETAIL_H_
#define LUXFIT_INVERSE_CHOOSE_SCENE_DETAIL_H_

#include <algorithm>

#include "inverse/model/fit_luminaires.h"
#include "inverse/select/detail_choice.h"

namespace luxfit {

struct SceneDetail {
  bool is_compared = false;
  DetailChoice bounces;                         // 0, 1, 2, 3, 4, all
  DetailChoice patches, elements;               // twice the size in use, the size in use
  double patch_size_m = 0, element_size_m = 0;  // in use: the median of the longer edges
  double patch_error = 0, element_error = 0;    // relative, of the sizes in use
  double model_error = 0;                       // relative, of the fit
  // Less than flux ratios are asked to be known to, or not what the fit's misfit comes from.
  bool IsFineEnough() const {
    return std::max(patch_error, element_error) <= std::max(0.005, 0.5 * model_error);
  }
};

// `fit` to `data`.
SceneDetail CompareDetail(const Room& room, const LightData& data, const LuminaireFit& fit);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_SCENE_DETAIL_H_
