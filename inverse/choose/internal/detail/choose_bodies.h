// Chooses when the bodies of luminaires that hang close below a surface are there.
//
// The fit goes on from where it is, by one round, with bodies that are there where the luminaire is on, and with bodies
// that are always there. Data left out decide (inverse/choose/internal/left_out.h), by the rule of
// inverse/select/one_standard_error.h.
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_CHOOSE_BODIES_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_CHOOSE_BODIES_H_

#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/select/internal/detail_choice.h"

namespace luxfit {

struct BodyChoice {
  LightState state;  // that of the chosen fit
  double relative_sigma = 0;
  DetailChoice presence;  // empty: no luminaire covers anything, or nothing can be left out
};

// `fit`: a converged fit to `data` without bodies.
BodyChoice ChooseBodies(const Room& room, const LightData& data, const LuminaireFit& fit,
                        const std::vector<ParameterPrior>& priors);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_CHOOSE_BODIES_H_
