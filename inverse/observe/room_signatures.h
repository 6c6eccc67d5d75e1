// Makes the signatures of a room's views from its photos (inverse/furniture/signature_view.h), in one camera's unit: divided by
// the stated gains of cameras (StatedGains).
#ifndef LUXFIT_INVERSE_OBSERVE_ROOM_SIGNATURES_H_
#define LUXFIT_INVERSE_OBSERVE_ROOM_SIGNATURES_H_

#include <vector>

#include "calib/lens/camera.h"
#include "calib/register/registration.h"
#include "inverse/furniture/signature_view.h"
#include "inverse/observe/room_photos.h"

namespace luxfit {

// `cameras`, `views`: of the registration. `states`: how many there are.
std::vector<SignatureView> SignaturesOf(const RoomPhotos& photos, const std::vector<Camera>& cameras,
                                        const std::vector<RegisteredView>& views, int states);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_ROOM_SIGNATURES_H_
