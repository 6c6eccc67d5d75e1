// Checks that the observations of a room fit together.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_EXPECT_WHOLE_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_EXPECT_WHOLE_H_

#include "forward/light/room.h"
#include "inverse/fit/room_observations.h"

namespace luxfit {

// Throws std::invalid_argument as FitRoom does.
void ExpectWhole(const Room& room, const RoomObservations& given);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_EXPECT_WHOLE_H_
