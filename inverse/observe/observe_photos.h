// Turns photos of a room into the evidence that a fit starts from, by the room's surveyed tags alone.
//
//   tags of every photo -> pose of every view, focal lengths -> Observe
//
// Of each view, the six photos of most light tell its pose. A photo whose tags are those of another view takes no part.
// Where the tags contradict a focal length (Registration::focal_scale), poses and pixels both take the corrected one.
// `luxfit run` goes the same way (apps/stages/register, apps/stages/observe), and has COLMAP beside it.
//
// Assumes a survey in the frame of the room's mesh. Views without a usable pose are left out; `registration.notes` says
// why. Throws std::invalid_argument as Observe does, and throws as FindTagCorners and RegisterViews do.
#ifndef LUXFIT_INVERSE_OBSERVE_OBSERVE_PHOTOS_H_
#define LUXFIT_INVERSE_OBSERVE_OBSERVE_PHOTOS_H_

#include <cstddef>
#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/register/registration.h"
#include "calib/targets/tags.h"
#include "forward/light/room.h"
#include "inverse/observe/evidence.h"
#include "inverse/observe/room_photos.h"
#include "inverse/observe/states_as_if.h"

namespace luxfit {

// Names a photo whose tags lie where another view shows them.
struct PhotoOfWrongView {
  size_t photo = 0;  // index into the photos as given
  std::string as_if_view;
  int tags = 0;  // that lie so
};

struct PhotoObservations {
  std::vector<Camera> cameras;  // with the focal lengths that the tags show
  Registration registration;
  std::vector<PhotoOfWrongView> misplaced;
  std::vector<size_t> used;  // index into the photos as given of each photo that `observed` numbers
  ObservedPhotos observed;
};

PhotoObservations ObservePhotos(const Room& room, const std::vector<Camera>& cameras,
                                const std::vector<SurveyedTag>& survey, const RoomPhotos& photos,
                                const StateTable& states, const std::string& tag_family = "tag36h11");

// Returns those of the photos, in that order.
RoomPhotos PhotosAt(const RoomPhotos& photos, const std::vector<size_t>& at);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_OBSERVE_PHOTOS_H_
