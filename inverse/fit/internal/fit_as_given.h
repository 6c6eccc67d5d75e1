// Fits a room, taking all that is given as right: the steps of FitRoom, once.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_FIT_AS_GIVEN_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_FIT_AS_GIVEN_H_

#include "inverse/fit/fit_room.h"

namespace luxfit {

// `observations` are whole (internal/expect_whole.h).
RoomFit FitAsGiven(const Room& room, const RoomObservations& observations, const FitRoomOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_FIT_AS_GIVEN_H_
