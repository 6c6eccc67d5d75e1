// Warns ("model_misfit") of observations that the best fit does not explain: they leave the luminaires' places in doubt.
//
// A row is unexplained where its residual is beyond five sigmas. The warning is given where that holds for 15 % of the
// rows of a state, or where the others miss by more than 2 % (1 sigma). A good mesh gives 5 and 0.5 %.
//
// Where one state alone reaches 15 %, its luminaires are elsewhere or shine otherwise: the result is undetermined.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_MISFIT_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_MISFIT_H_

#include "inverse/fit/fit_room.h"

namespace luxfit {

void WarnOfMisfit(const Room& room, const RoomFit& result, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_MISFIT_H_
