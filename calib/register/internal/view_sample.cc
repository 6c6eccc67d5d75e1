#include "calib/register/internal/view_sample.h"

#include <algorithm>

namespace luxfit {

std::vector<BundleView> SampleOf(const std::vector<BundleView>& views) {
  // More would not change a verdict, and every hypothesis is tested on all of them.
  constexpr std::size_t kMostViews = 4, kMostTags = 4;
  std::vector<BundleView> sample;
  for (const BundleView& view : views) {
    if (view.tags.size() >= 2) sample.push_back(view);
  }
  std::stable_sort(sample.begin(), sample.end(),
                   [](const BundleView& a, const BundleView& b) { return a.tags.size() > b.tags.size(); });
  sample.resize(std::min(sample.size(), kMostViews));
  for (BundleView& view : sample) {
    std::stable_sort(view.tags.begin(), view.tags.end(),
                     [](const TagObservation& a, const TagObservation& b) { return a.side_px > b.side_px; });
    view.tags.resize(std::min(view.tags.size(), kMostTags));
  }
  return sample;
}

}  // namespace luxfit
