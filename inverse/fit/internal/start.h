// Makes the start of a fit: what is given, completed by a first guess.
//
// Reflectances and the camera's scale are known, to be estimated, or out of reach; luminaires have the place,
// flux and photometry that are given, and what the guess says of the rest. What is given with a sigma becomes
// a prior.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_START_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_START_H_

#include <vector>

#include "forward/light/room.h"
#include "inverse/fit/internal/room_light.h"

namespace luxfit {

struct FitStart {
  LightState state;
  std::vector<bool> luminaire_found;           // without a place it gives no light
  std::vector<std::vector<Luminaire>> rivals;  // of each luminaire's first guess
  std::vector<ParameterPrior> priors;          // of `light`, and of what is given of luminaires
  bool flux_known = false;                     // of one luminaire at least: the scale
};

// `guess_from`: the data of `light` with the indirect light that photos measured, or readings alone. Records
// choices, warns of what is not determined.
FitStart StartFit(const Room& room, const RoomObservations& given, const RoomLight& light,
                  const LightData& guess_from, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_START_H_
