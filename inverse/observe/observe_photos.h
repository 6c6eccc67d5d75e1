// Turns photos of a room into the evidence that a fit starts from, by the room's surveyed tags alone.
//
//   tags of every photo -> pose of every view, focal lengths -> furniture -> Observe
//
// The six brightest photos of each view tell its pose. A photo whose tags are those of another view takes no part.
// Where the tags contradict a focal length (Registration::focal_scale), poses and pixels both take the corrected one.
// Where furniture is looked for and found, what photos show is observed in the room with it. `luxfit run` goes the same way (apps/stages/register, apps/stages/observe), and has COLMAP beside it.
//
// Assumes a survey in the frame of the room's mesh. Views without a usable pose are left out; `registration.notes` says
// why. Throws std::invalid_argument as Observe does, and throws as FindTagCorners and RegisterViews do.
#ifndef LUXFIT_INVERSE_OBSERVE_OBSERVE_PHOTOS_H_
#define LUXFIT_INVERSE_OBSERVE_OBSERVE_PHOTOS_H_

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/register/registration.h"
#include "calib/targets/tags.h"
#include "forward/light/room.h"
#include "forward/room/scene.h"
#include "inverse/observe/as_if/states_as_if.h"
#include "inverse/observe/evidence.h"
#include "inverse/observe/room_furniture.h"
#include "inverse/observe/room_photos.h"

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
  RevisedRoom furniture;
  std::shared_ptr<const Room>
      changed_room;  // with that furniture; null: the room as given. `observed` is of this room
  ObservedPhotos observed;
};

// Says how the room was made, so that it can be made again with the furniture that photos show.
struct FurnitureSearch {
  Scene mesh;  // as given
  RoomOptions options;
  std::vector<Eigen::Vector3d> free_places;  // world frame, m: where meters stood, no solid is
};

struct ObservePhotosOptions {
  std::string tag_family = "tag36h11";
  std::optional<FurnitureSearch> furniture;  // absent: the room has what the mesh has
};

PhotoObservations ObservePhotos(const Room& room, const std::vector<Camera>& cameras,
                                const std::vector<SurveyedTag>& survey, const RoomPhotos& photos,
                                const StateTable& states, const ObservePhotosOptions& options = {});

// Returns those of the photos, in that order.
RoomPhotos PhotosAt(const RoomPhotos& photos, const std::vector<size_t>& at);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_OBSERVE_PHOTOS_H_
