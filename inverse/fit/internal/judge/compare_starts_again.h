// Compares places that explained a luminaire's light equally once more, with what the whole fit knows.
//
// A lobe of any width may imitate at one place what a known one shows to lie at another: now luminaires have their final
// models, and what their types have in common is held.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_COMPARE_STARTS_AGAIN_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_COMPARE_STARTS_AGAIN_H_

#include <set>
#include <vector>

#include "inverse/choose/internal/several_starts.h"
#include "inverse/model/fit_luminaires.h"

namespace luxfit {

// `settled`: luminaires whose places photos tell; they are not compared. Puts each comparison whose first start is still
// the best in place of the one in `starts`. Does nothing without photos.
void CompareStartsAgain(const Room& room, const LightData& data, const LuminaireFit& fit,
                        const std::vector<ParameterPrior>& priors, const std::set<int>& settled,
                        std::vector<StartComparison>& starts);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_COMPARE_STARTS_AGAIN_H_
