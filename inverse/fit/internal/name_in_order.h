// Gives luminaires that nothing tells apart their names in the order of their places.
//
// Luminaires of one type that are always on together at one level are interchangeable: their light is the same
// whichever name is at which place. A fit may end with them in any order, so that two fits of one room would disagree
// about which luminaire is the weak one.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_NAME_IN_ORDER_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_NAME_IN_ORDER_H_

#include "inverse/fit/room_observations.h"
#include "inverse/model/light_state.h"

namespace luxfit {

// Returns whether nothing but its name is given of a luminaire.
bool IsNothingKnownOf(const KnownLuminaire& luminaire);

// Returns the state with the interchangeable luminaires of each type in the order of their places (OrderOfPlaces). Luminaires of
// which anything is given keep their places.
LightState WithNamesInOrder(const RoomObservations& given, LightState state);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_NAME_IN_ORDER_H_
