// Chooses how much detail the light of a scene needs: reflections, sizes of patches and elements, number of rows.
//
// A coarser model leaves light out of the photos' rows:
//
//   n reflections             F (M - M_n),  M_n = sum_{k < n} (rho F)^k rho D    M: exitance, D: direct light
//   patches twice as large    F (M - mean of M over 2 x 2 patches)
//   elements twice as large   3 (mean of E over an element - E at its centre)
//   half of the elements      the rows of the other half
//
// Its effect on the answer is predicted by one Gauss-Newton step (inverse/model/internal/intervals/parameter_shift.h): the
// largest shift of a parameter in units of its sigma. The coarsest model whose effect is below a tenth is enough.
// The fit need not be repeated for that. The light that readings lose does not count.
//
// The sizes in use leave out a third of the change from twice the size (an error of second order in the
// size). The fit subtracts it, to about a third of itself (inverse/model/internal/discretisation_bias.h). Both hold
// for the effect as for the light. D is sampled at three elements per patch.
//
// The error of the light by the sizes in use is relative and robust (1.48 times the median). It should be below half
// of the fit's own model error, or below 0.5 %.
//
// Without photos, a usable fit or its covariance, is_compared stays false.
// Sources: Pereyra (1966) (deferred correction); Richardson (1911) (the third).
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_SCENE_DETAIL_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_SCENE_DETAIL_H_

#include <algorithm>
#include <string>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/model/internal/intervals/parameter_shift.h"

namespace luxfit {

struct EffectCandidate {
  std::string name;
  LargestShift effect;  // by leaving out what this model does not have
};

struct EffectChoice {
  std::vector<EffectCandidate> among;  // coarsest first
  size_t chosen = 0;                   // the first with an effect below kWorthSigmas, else the last

  const EffectCandidate& Chosen() const { return among[chosen]; }
};

// Sets `chosen` by the effects. `among` is not empty.
EffectChoice ChooseByEffect(std::vector<EffectCandidate> among);

// The share of the discretisation's effect that may be left after the fit subtracted it.
constexpr double kDiscretisationLeft = 1.0 / 3;

struct SceneDetail {
  bool is_compared = false;
  EffectChoice bounces;  // 0, 1, 2, 3, 4, all
  EffectChoice patches,
      elements;       // twice the size in use, the size in use (before the fit subtracts its effect)
  EffectChoice rows;  // half of the elements that were fitted, all of them
  double patch_size_m = 0, element_size_m = 0;  // sizes in use: median of the longer edges
  double patch_error = 0, element_error = 0;    // relative, by the sizes in use
  double model_error = 0;                       // relative, of the fit
  // Returns whether the sizes' error is below the accuracy of flux ratios, or too small to explain the
  // misfit.
  bool IsFineEnough() const {
    return std::max(patch_error, element_error) <= std::max(0.005, 0.5 * model_error);
  }
};

// `fit`: the fit to `data` by `priors`.
SceneDetail CompareDetail(const Room& room, const LightData& data, const LuminaireFit& fit,
                          const std::vector<ParameterPrior>& priors);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_SCENE_DETAIL_H_
