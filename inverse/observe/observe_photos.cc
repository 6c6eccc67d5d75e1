#include "inverse/observe/observe_photos.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

#include "calib/luminance/bright_blobs.h"
#include "calib/targets/tags.h"
#include "inverse/observe/observe.h"

namespace luxfit {
namespace {

// Returns the tags of every view, combined from its photos.
std::vector<ViewDetections> DetectViews(const std::vector<Camera>& cameras,
                                        const std::vector<RoomPhoto>& photos, const std::string& tag_family) {
  std::vector<std::vector<TagDetection>> found(photos.size());
  tbb::parallel_for(size_t{0}, photos.size(), [&](size_t i) {
    found[i] = FindTagCorners(photos[i].image, cameras[static_cast<size_t>(photos[i].camera)], tag_family);
  });
  std::map<std::string, std::vector<size_t>> photos_of_view;
  for (size_t i = 0; i < photos.size(); ++i) photos_of_view[photos[i].view].push_back(i);
  std::vector<ViewDetections> views;
  for (const auto& [view, members] : photos_of_view) {
    std::vector<std::vector<TagDetection>> detections;
    for (const size_t i : members) detections.push_back(found[i]);
    views.push_back({view, photos[members.front()].camera, CombineDetections(detections)});
  }
  return views;
}

}  // namespace

PhotoObservations ObservePhotos(const Room& room, const std::vector<Camera>& cameras,
                                const std::vector<SurveyedTag>& survey, const std::vector<RoomPhoto>& photos,
                                const std::string& tag_family) {
  for (const RoomPhoto& photo : photos)
    if (photo.camera < 0 || static_cast<size_t>(photo.camera) >= cameras.size() || photo.state < 0)
      throw std::invalid_argument("ObservePhotos: expected a camera of the list and a state >= 0");
  PhotoObservations observed;
  observed.registration = RegisterViews(cameras, survey, DetectViews(cameras, photos, tag_family));
  const std::vector<RegisteredView>& views = observed.registration.views;
  std::vector<PixelDirections> directions;
  directions.reserve(cameras.size());
  for (const Camera& camera : cameras) directions.push_back(UnprojectAllPixels(camera));
  std::vector<PixelMap> maps;
  for (const RegisteredView& view : views) {
    const auto c = static_cast<size_t>(view.camera);
    maps.push_back(MapPixels(cameras[c], directions[c], view.cam_from_world, room,
                             TagQuads(survey, cameras[c], view.cam_from_world)));
  }
  std::vector<PhotoBlobs> blobs;
  for (const RoomPhoto& photo : photos) {
    const auto view = std::find_if(views.begin(), views.end(),
                                   [&](const RegisteredView& v) { return v.view == photo.view; });
    if (view == views.end()) continue;
    const auto index = static_cast<int>(view - views.begin());
    blobs.push_back({index, photo.state, FindBrightBlobs(photo.image)});
    const std::vector<Observation> seen =
        ObservePhoto(maps[static_cast<size_t>(index)], photo.image, index, photo.state);
    observed.observations.insert(observed.observations.end(), seen.begin(), seen.end());
  }
  SeenLuminairesOptions seen_options;
  seen_options.tags = survey;
  observed.seen = FindSeenLuminaires(room, cameras, views, blobs, seen_options);
  observed.outlines = FindSeenOutlines(cameras, views, blobs);
  return observed;
}

}  // namespace luxfit
