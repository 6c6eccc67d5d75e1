#include "calib/register/feature_model.h"

#include <set>
#include <stdexcept>
#include <utility>

namespace luxfit {
namespace {

// Image id of each view: the image with most points.
std::map<std::string, int> ImageOfView(const ColmapModel& model,
                                       const std::map<std::string, std::string>& view_of_image) {
  std::map<int, int> points;
  for (const auto& [id, point] : model.points) {
    for (const ColmapTrackElement& element : point.track) ++points[element.image];
  }
  std::map<std::string, int> image_of_view;
  for (const auto& [id, image] : model.images) {
    const auto view = view_of_image.find(image.name);
    if (view == view_of_image.end()) continue;
    const auto [at, is_new] = image_of_view.emplace(view->second, id);
    if (!is_new && points[id] > points[at->second]) at->second = id;
  }
  return image_of_view;
}

}  // namespace

FeatureModel FeaturesOf(const ColmapModel& model, const std::map<std::string, std::string>& view_of_image) {
  FeatureModel features;
  std::map<int, int> view_of_id;
  for (const auto& [view, id] : ImageOfView(model, view_of_image)) {
    view_of_id[id] = static_cast<int>(features.views.size());
    features.views.push_back({view, model.images.at(id).cam_from_model});
  }
  for (const auto& [id, point] : model.points) {
    FeatureTrack track;
    track.p_in_model = point.p_in_model;
    std::set<int> seen;
    for (const ColmapTrackElement& element : point.track) {
      const auto view = view_of_id.find(element.image);
      if (view == view_of_id.end() || !seen.insert(view->second).second) continue;
      track.seen.push_back(
          {view->second,
           model.images.at(element.image).keypoints_px[static_cast<std::size_t>(element.keypoint)]});
    }
    if (track.seen.size() >= 2) features.tracks.push_back(std::move(track));
  }
  return features;
}

FeatureModel Moved(const FeatureModel& features, const Similarity& b_from_model) {
  FeatureModel moved = features;
  for (FeatureView& view : moved.views) view.cam_from_model = PoseUnder(b_from_model, view.cam_from_model);
  for (FeatureTrack& track : moved.tracks) {
    if (track.surface) throw std::invalid_argument("Moved: a track lies on a surface already");
    track.p_in_model = b_from_model * track.p_in_model;
  }
  return moved;
}

}  // namespace luxfit
