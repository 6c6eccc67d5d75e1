#include "inverse/observe/observe_photos.h"

#include <algorithm>
#include <utility>

#include "calib/register/view_tags.h"
#include "inverse/observe/internal/expect_known.h"
#include "inverse/observe/room_furniture.h"
#include "inverse/observe/scene_surface.h"

namespace luxfit {
namespace {

ViewTags TagsOf(const std::vector<Camera>& cameras, const RoomPhotos& photos, const StateTable& states,
                const std::string& tag_family) {
  std::vector<std::string> view;
  std::vector<double> light;
  std::vector<int> camera;
  for (const RoomPhoto& photo : photos.photos) {
    view.push_back(photo.view);
    light.push_back(states.dimming[static_cast<size_t>(photo.state)].sum());
    camera.push_back(photo.camera);
  }
  return FindViewTags(MostLitPhotos(view, light), camera, [&](size_t i) {
    return FindTagCorners(*photos.read(i), cameras[static_cast<size_t>(camera[i])], tag_family);
  });
}

// Makes the room anew where photos show other furniture.
void LookForFurniture(const FurnitureSearch& search, const Room& room, const std::vector<SurveyedTag>& survey,
                      const RoomPhotos& photos, int states, PhotoObservations& seen) {
  std::vector<Eigen::Vector3d> free_places = search.free_places;
  for (const SurveyedTag& tag : survey) free_places.push_back(tag.center_in_world);
  seen.furniture = LookForFurniture(search.mesh, room.scene, photos, seen.cameras, seen.registration.views,
                                    states, free_places, survey);
  const FurnitureChange change = ChangeOf(seen.furniture);
  if (!change.IsEmpty())
    seen.changed_room =
        std::make_shared<const Room>(MakeRoom(WithChange(search.mesh, change), search.options));
}

}  // namespace

RoomPhotos PhotosAt(const RoomPhotos& photos, const std::vector<size_t>& at) {
  RoomPhotos some{photos.cameras, {}, nullptr};
  for (const size_t photo : at) some.photos.push_back(photos.photos.at(photo));
  some.read = [read = photos.read, at](size_t photo) { return read(at.at(photo)); };
  return some;
}

PhotoObservations ObservePhotos(const Room& room, const std::vector<Camera>& cameras,
                                const std::vector<SurveyedTag>& survey, const RoomPhotos& photos,
                                const StateTable& states, const ObservePhotosOptions& options) {
  ExpectKnown(photos, cameras, states);
  PhotoObservations seen;
  const ViewTags tags = TagsOf(cameras, photos, states, options.tag_family);
  for (const PhotoOfOtherView& other : tags.of_other_views)
    seen.misplaced.push_back({other.photo, tags.views[static_cast<size_t>(other.as_if)].view, other.tags});
  RegisterViewsOptions registration;
  registration.surface = SurfaceOf(room.scene);
  seen.registration = RegisterViews(cameras, survey, tags.views, registration);
  seen.cameras = cameras;
  for (size_t c = 0; c < seen.registration.focal_scale.size(); ++c)
    seen.cameras[c] = WithFocalScale(cameras[c], seen.registration.focal_scale[c]);
  for (size_t i = 0; i < photos.photos.size(); ++i) {
    const auto is_it = [i](const PhotoOfWrongView& m) { return m.photo == i; };
    if (std::none_of(seen.misplaced.begin(), seen.misplaced.end(), is_it)) seen.used.push_back(i);
  }
  const RoomPhotos used = PhotosAt(photos, seen.used);
  if (options.furniture)
    LookForFurniture(*options.furniture, room, survey, used, static_cast<int>(states.states.size()), seen);
  ObserveOptions observe;
  observe.tags = survey;
  seen.observed = Observe(seen.changed_room ? *seen.changed_room : room, used, seen.cameras,
                          seen.registration, states, observe);
  return seen;
}

}  // namespace luxfit
