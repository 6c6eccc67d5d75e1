#include "calib/register/view_tags.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace luxfit {
namespace {

constexpr std::size_t kPhotosPerView = 6;

}  // namespace

PhotosOfViews MostLitPhotos(const std::vector<std::string>& view, const std::vector<double>& light) {
  PhotosOfViews photos;
  for (std::size_t i = 0; i < view.size(); ++i) photos[view[i]].push_back(i);
  for (auto& [name, own] : photos) {
    std::stable_sort(own.begin(), own.end(),
                     [&](std::size_t a, std::size_t b) { return light.at(a) > light.at(b); });
    own.resize(std::min(own.size(), kPhotosPerView));
  }
  return photos;
}

ViewTags FindViewTags(const PhotosOfViews& photos, const std::vector<int>& camera,
                      const std::function<std::vector<TagDetection>(std::size_t photo)>& detect) {
  ViewTags found;
  std::vector<std::size_t> jobs;
  std::vector<PhotoTags> tags;
  for (const auto& [view, own] : photos) {
    for (const std::size_t photo : own) {
      jobs.push_back(photo);
      tags.push_back({static_cast<int>(found.views.size()), {}});
    }
    found.views.push_back({view, camera.at(own.front()), {}});
  }
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) { tags[i].tags = detect(jobs[i]); });
  for (PhotoOfOtherView other : FindPhotosOfOtherViews(tags)) {
    tags[other.photo].tags.clear();
    other.photo = jobs[other.photo];
    found.of_other_views.push_back(other);
  }
  std::vector<std::vector<std::vector<TagDetection>>> of_view(found.views.size());
  for (const PhotoTags& photo : tags) of_view[static_cast<std::size_t>(photo.view)].push_back(photo.tags);
  for (std::size_t v = 0; v < of_view.size(); ++v) found.views[v].tags = CombineDetections(of_view[v]);
  return found;
}

}  // namespace luxfit
