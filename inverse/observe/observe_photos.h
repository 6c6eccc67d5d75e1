// Turns photos of a room into the observations that a fit needs, by the room's surveyed tags alone.
//
//   tags of every photo -> pose of every view -> luminance of every element -> places where luminaires show
//
// Assumes cameras of known lens, linear photos, and a survey in the frame of the room's mesh. Views without a
// usable pose are left out; `registration.notes` says why. Throws std::invalid_argument for a camera or state
// out of range, and throws as FindTagCorners and RegisterViews do.
#ifndef LUXFIT_INVERSE_OBSERVE_OBSERVE_PHOTOS_H_
#define LUXFIT_INVERSE_OBSERVE_OBSERVE_PHOTOS_H_

#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/luminance/luminance.h"
#include "calib/register/registration.h"
#include "calib/targets/tags.h"
#include "forward/light/room.h"
#include "inverse/observe/observe.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

struct RoomPhoto {
  std::string view;  // photos of one view share one pose
  int camera = 0;    // index into `cameras`
  int state = 0;     // state of the luminaires
  LuminanceImage image;
};

struct PhotoObservations {
  Registration registration;
  std::vector<Observation> observations;  // all views; Observation::view indexes registration.views
  std::vector<SeenPlace> seen;
  std::vector<SeenOutline> outlines;
};

PhotoObservations ObservePhotos(const Room& room, const std::vector<Camera>& cameras,
                                const std::vector<SurveyedTag>& survey, const std::vector<RoomPhoto>& photos,
                                const std::string& tag_family = "tag36h11");

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_OBSERVE_PHOTOS_H_
