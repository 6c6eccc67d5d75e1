#include "apps/stages/register/view_tags.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "calib/register/photos_of_views.h"
#include "calib/targets/tags.h"

namespace luxfit {
namespace {

// Several photos of one pose average noise and outvote a corner that one of them shows badly. The pixel
// grid's error is common to all of them.
constexpr size_t kPhotosPerView = 6;

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
  std::map<std::string, std::vector<const Photo*>> views;
  for (const Photo& photo : photos) views[photo.view].push_back(&photo);
  for (auto& [view, own] : views) {
    std::stable_sort(own.begin(), own.end(), [&](const Photo* a, const Photo* b) {
      return DimmingSum(session, a->state) > DimmingSum(session, b->state);
    });
    own.resize(std::min(own.size(), kPhotosPerView));
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
  DetectedViews detected{ViewsWithoutTags(views), {}};
  std::vector<std::pair<size_t, const LinearizedPhoto*>> jobs;
  size_t index = 0;
  for (const auto& [view, own] : views) {
    for (const LinearizedPhoto* photo : own) jobs.push_back({index, photo});
    ++index;
  }
  std::vector<PhotoTags> found(jobs.size());
  tbb::parallel_for(size_t{0}, jobs.size(), [&](size_t i) {
    const LinearizedPhoto& photo = *jobs[i].second;
    const Camera& camera = cameras[static_cast<size_t>(photo.camera)];
    found[i] = {static_cast<int>(jobs[i].first),
                FindTagCorners(*ReadKept(photos, photo, camera, context), camera, session.tags.family)};
    Advance(context, jobs.size());
  });
  for (const PhotoOfOtherView& other : FindPhotosOfOtherViews(found)) {
    const LinearizedPhoto& photo = *jobs[other.photo].second;
    detected.photos.push_back(
        {photo.view, photo.state, detected.views[static_cast<size_t>(other.as_if)].view, other.tags});
    found[other.photo].tags.clear();
  }
  std::vector<std::vector<std::vector<TagDetection>>> of_view(detected.views.size());
  for (const PhotoTags& photo : found) of_view[static_cast<size_t>(photo.view)].push_back(photo.tags);
  for (size_t v = 0; v < of_view.size(); ++v) detected.views[v].tags = CombineDetections(of_view[v]);
  return detected;
}

}  // namespace luxfit
