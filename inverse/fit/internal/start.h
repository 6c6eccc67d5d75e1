// Makes the start of a fit from what is given, completed by a first guess.
//
// Each reflectance and the camera's scale are known, to be estimated, or out of reach. Luminaires have the
// place, flux and photometry that are given; the guess supplies the rest. A value given with a sigma becomes
// a prior. A place that photos show to three views or more is kept beside it (FitStart::seen): knowledge of its own,
// as long as no outline says more.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_START_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_START_H_

#include <optional>
#include <vector>

#include "forward/light/room.h"
#include "inverse/fit/internal/room_light.h"

namespace luxfit {

struct FitStart {
  LightState state;
  std::vector<bool> luminaire_found;           // false: it has no place and gives no light
  std::vector<std::vector<Luminaire>> rivals;  // alternatives to each luminaire's first guess
  std::vector<ParameterPrior> priors;          // those of `light`, and those given for luminaires
  std::vector<std::optional<SeenPlace>> seen;  // by luminaire, the place in photos from which it starts
  bool flux_known = false;                     // at least one luminaire's, which sets the scale
};

// `guess_from`: the data of `light` with the indirect light that photos measured, or readings alone. Records
// choices and warns of what is not determined.
FitStart StartFit(const Room& room, const RoomObservations& given, const RoomLight& light,
                  const LightData& guess_from, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_START_H_
