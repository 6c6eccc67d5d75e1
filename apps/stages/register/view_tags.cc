#include "apps/stages/register/view_tags.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

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

std::vector<ViewDetections> ViewsWithoutTags(const ViewPhotos& views) {
  std::vector<ViewDetections> detections;
  for (const auto& [view, photos] : views) detections.push_back({view, photos.front()->camera, {}});
  return detections;
}

std::vector<ViewDetections> DetectViews(const Session& session, const LinearizedPhotos& photos,
                                        const std::vector<Camera>& cameras, const ViewPhotos& views,
                                        const RunContext& context) {
  std::vector<ViewDetections> detections = ViewsWithoutTags(views);
  std::vector<std::pair<size_t, const LinearizedPhoto*>> jobs;
  size_t index = 0;
  for (const auto& [view, own] : views) {
    for (const LinearizedPhoto* photo : own) jobs.push_back({index, photo});
    ++index;
  }
  std::vector<std::vector<TagDetection>> found(jobs.size());
  tbb::parallel_for(size_t{0}, jobs.size(), [&](size_t i) {
    const LinearizedPhoto& photo = *jobs[i].second;
    const Camera& camera = cameras[static_cast<size_t>(photo.camera)];
    found[i] = FindTagCorners(*ReadKept(photos, photo, camera, context), camera, session.tags.family);
    Advance(context, jobs.size());
  });
  std::vector<std::vector<std::vector<TagDetection>>> of_view(detections.size());
  for (size_t i = 0; i < jobs.size(); ++i) of_view[jobs[i].first].push_back(found[i]);
  for (size_t v = 0; v < detections.size(); ++v) detections[v].tags = CombineDetections(of_view[v]);
  return detections;
}

}  // namespace luxfit
