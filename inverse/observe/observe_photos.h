// Goes from photos of a room to what a fit starts from, by the room's surveyed tags alone.
//
//   tags of every photo -> a pose for every view -> luminance of every element -> places where luminaires show
//
// Assumes cameras of known lens, photos that are linear, and a survey in the frame of the room's mesh. Views without a usable
// pose are left out; `registration.notes` says why. Throws std::invalid_argument for a camera or state out of range, and as
// FindTagCorners and RegisterViews do.
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
  int camera = 0;    // of `cameras`
  int state = 0;     // of the light
  LuminanceImage image;
};

struct PhotoObservations {
  Registration registration;
  std::vector<Observation> observations;  // of every view (Observation::view counts registration.views)
  std::vector<SeenPlace> seen;
};

PhotoObservations ObservePhotos(const Room& room, const std::vector<Camera>& cameras,
                                const std::vector<SurveyedTag>& survey, const std::vector<RoomPhoto>& photos,
                                const std::string& tag_family = "tag36h11");

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_OBSERVE_PHOTOS_H_
