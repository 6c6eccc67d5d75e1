// Scales the fluxes of a fit to the luxmeter's readings, and the camera's scale against them.
//
// The light is linear in the fluxes, so one factor does it exactly: the sum of the readings over the sum of
// their predictions. Fluxes that are not free, or that are given, keep their values.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_MATCH_SCALE_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_MATCH_SCALE_H_

#include "forward/light/room.h"
#include "inverse/fit/room_observations.h"
#include "inverse/model/light_state.h"

namespace luxfit {

// `data`: of which the readings in use count. Returns the state unchanged where there is no light in them.
LightState WithMatchedScale(const Room& room, const RoomObservations& given, const LightData& data,
                            LightState state);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_MATCH_SCALE_H_
