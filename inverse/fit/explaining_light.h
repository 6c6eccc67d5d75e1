// Gives the light of a fit to those who ask how its readings were taken (inverse/check/explain_readings.h).
#ifndef LUXFIT_INVERSE_FIT_EXPLAINING_LIGHT_H_
#define LUXFIT_INVERSE_FIT_EXPLAINING_LIGHT_H_

#include <optional>
#include <string>
#include <vector>

#include "forward/light/room.h"
#include "inverse/check/explain_readings.h"
#include "inverse/fit/fit_room.h"

namespace luxfit {

// Returns the light by the model that predicts the fit's own readings, bodies and colours included. Keeps references:
// `room` and `fit` must outlive it. Nothing where the light rests on readings alone, or was not fitted.
// `states`: their names, as many as the fit has.
std::optional<ExplainingLight> ExplainingLightOf(const Room& room, const RoomFit& fit,
                                                 const std::vector<std::string>& states);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_EXPLAINING_LIGHT_H_
