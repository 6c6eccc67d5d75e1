#include "apps/stages/register/view_tags.h"

#include <utility>

#include "calib/register/view_tags.h"
#include "calib/targets/tags.h"

namespace luxfit {
namespace {

double DimmingSum(const Session& session, const std::string& photo_state) {
  for (const SessionState& state : session.states) {
    if (state.id != photo_state) continue;
    double sum = 0;
    for (const auto& [id, dimming] : state.dimming) sum += dimming;
    return sum;
  }
  return 0;
}

}  // namespace

template <typename Photo>
std::map<std::string, std::vector<const Photo*>> PhotosByView(const Session& session,
                                                              const std::vector<Photo>& photos) {
  std::vector<std::string> view;
  std::vector<double> light;
  for (const Photo& photo : photos) {
    view.push_back(photo.view);
    light.push_back(DimmingSum(session, photo.state));
  }
  std::map<std::string, std::vector<const Photo*>> views;
  for (const auto& [name, own] : MostLitPhotos(view, light)) {
    for (const size_t photo : own) views[name].push_back(&photos[photo]);
  }
  return views;
}
template std::map<std::string, std::vector<const SessionPhoto*>> PhotosByView(
    const Session& session, const std::vector<SessionPhoto>& photos);
template ViewPhotos PhotosByView(const Session& session, const std::vector<LinearizedPhoto>& photos);

bool HasTags(const Session& session) { return !session.tags.survey.empty() || session.tags.size_m > 0; }

std::vector<ViewDetections> ViewsWithoutTags(const ViewPhotos& views) {
  std::vector<ViewDetections> detections;
  for (const auto& [view, photos] : views) detections.push_back({view, photos.front()->camera, {}});
  return detections;
}

DetectedViews DetectViews(const Session& session, const LinearizedPhotos& photos,
                          const std::vector<Camera>& cameras, const ViewPhotos& views,
                          const RunContext& context) {
  std::vector<const LinearizedPhoto*> of_views;
  std::vector<int> camera;
  PhotosOfViews indices;
  for (const auto& [view, own] : views) {
    for (const LinearizedPhoto* photo : own) {
      indices[view].push_back(of_views.size());
      of_views.push_back(photo);
      camera.push_back(photo->camera);
    }
  }
  ViewTags tags = FindViewTags(indices, camera, [&](size_t i) {
    const LinearizedPhoto& photo = *of_views[i];
    const Camera& own = cameras[static_cast<size_t>(photo.camera)];
    Advance(context, of_views.size());
    return FindTagCorners(*ReadKept(photos, photo, own, context), own, session.tags.family);
  });
  DetectedViews detected;
  for (const PhotoOfOtherView& other : tags.of_other_views) {
    const LinearizedPhoto& photo = *of_views[other.photo];
    detected.photos.push_back(
        {photo.view, photo.state, tags.views[static_cast<size_t>(other.as_if)].view, other.tags});
  }
  detected.views = std::move(tags.views);
  return detected;
}

}  // namespace luxfit
