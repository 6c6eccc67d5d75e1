// Compares how much detail the light of a scene needs: reflections, and the sizes of patches and elements.
//
// The comparison takes the fitted state, with no further fit. A coarser model predicts the fit's own
// prediction less the light that it leaves out:
//
//   n reflections             F (M - M_n),  M_n = sum_{k < n} (rho F)^k rho D    M: exitance, D: direct light
//   patches twice as large    F (M - mean of M over 2 x 2 patches)
//   elements twice as large   E - mean of E over 2 x 2 elements
//
// Free reflectances may adapt: each material gets the factor with which the coarser prediction fits four
// fifths of the patches. The fifth left out is scored by the mean of min(z^2, 9). The photos need the
// simplest model within one standard error of the best. D is sampled at three elements per patch.
//
// The sizes in use leave out a third of the change from twice the size (an error of second order in the
// size). The error is relative and robust (1.48 times the median). It should be below half of the fit's own
// model error, or below 0.5 %.
//
// Without photos or a usable fit, is_compared stays false.
// Sources: Breiman et al. (1984), sec. 3.4 (one-standard-error rule); Richardson (1911) (the third).
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_SCENE_DETAIL_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_SCENE_DETAIL_H_

#include <algorithm>

#include "inverse/model/fit_luminaires.h"
#include "inverse/select/internal/detail_choice.h"

namespace luxfit {

struct SceneDetail {
  bool is_compared = false;
  DetailChoice bounces;                         // 0, 1, 2, 3, 4, all
  DetailChoice patches, elements;               // twice the size in use, the size in use
  double patch_size_m = 0, element_size_m = 0;  // sizes in use: median of the longer edges
  double patch_error = 0, element_error = 0;    // relative, by the sizes in use
  double model_error = 0;                       // relative, of the fit
  // Returns whether the sizes' error is below the accuracy of flux ratios, or too small to explain the
  // misfit.
  bool IsFineEnough() const {
    return std::max(patch_error, element_error) <= std::max(0.005, 0.5 * model_error);
  }
};

// `fit`: the fit to `data`.
SceneDetail CompareDetail(const Room& room, const LightData& data, const LuminaireFit& fit);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_SCENE_DETAIL_H_
