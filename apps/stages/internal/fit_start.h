// What a fit starts from: what the session gives, completed by a first guess.
//
// Reflectances and the camera's scale are known, to be estimated, or out of reach; luminaires have the place,
// flux and photometry that are given, and what the guess says of the rest. What is given with a sigma becomes
// a prior.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_FIT_START_H_
#define LUXFIT_APPS_STAGES_INTERNAL_FIT_START_H_

#include <vector>

#include "apps/stages/internal/light_data.h"
#include "apps/stages/stages.h"

namespace luxfit {

struct FitStart {
  LightState state;
  std::vector<bool> luminaire_found;           // without a place it gives no light
  std::vector<std::vector<Luminaire>> rivals;  // of each luminaire's first guess
  std::vector<ParameterPrior> priors;          // of `light`, and of what is given of luminaires
  bool flux_known = false;                     // of one luminaire at least: the scale
};

// `guess_from`: the data of `light` with the indirect light that photos measured, or readings alone. Records
// choices, warns of what is not determined. Throws as ReadGivenLuminaire does.
FitStart StartFit(const Session& session, const Room& room, const SessionLight& light,
                  const LightData& guess_from, const std::vector<SeenPlace>& seen, RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_FIT_START_H_
