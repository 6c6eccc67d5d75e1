// Checks that photos, lenses and states fit together.
#ifndef LUXFIT_INVERSE_OBSERVE_INTERNAL_EXPECT_KNOWN_H_
#define LUXFIT_INVERSE_OBSERVE_INTERNAL_EXPECT_KNOWN_H_

#include <vector>

#include "calib/lens/camera.h"
#include "inverse/observe/as_if/states_as_if.h"
#include "inverse/observe/room_photos.h"

namespace luxfit {

// Throws std::invalid_argument unless there is one lens for each camera, one dimming for each state, and photos are of
// these.
void ExpectKnown(const RoomPhotos& photos, const std::vector<Camera>& cameras, const StateTable& states);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_INTERNAL_EXPECT_KNOWN_H_
