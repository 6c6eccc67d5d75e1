#include "inverse/observe/internal/expect_known.h"

#include <stdexcept>

namespace luxfit {

void ExpectKnown(const RoomPhotos& photos, const std::vector<Camera>& cameras, const StateTable& states) {
  bool is_known = photos.cameras.size() == cameras.size() && states.states.size() == states.dimming.size();
  for (const RoomPhoto& photo : photos.photos)
    is_known = is_known && photo.camera >= 0 && photo.camera < static_cast<int>(cameras.size()) &&
               photo.state >= 0 && photo.state < static_cast<int>(states.states.size());
  if (!is_known)
    throw std::invalid_argument(
        "Observe: expected one lens for each camera, one dimming for each state, and photos of these");
}

}  // namespace luxfit
