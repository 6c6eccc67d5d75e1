#include "inverse/model/internal/search/watched_places.h"

#include <algorithm>
#include <cmath>

namespace luxfit {
namespace {

constexpr double kBright = 0.3;  // of the peak
constexpr int kEnough = 3;       // views, as IsSure has it

double ShareOfPeak(const Lobe& lobe, const Eigen::Vector3d& direction) {
  if (lobe.distribution == Distribution::kIsotropic) return 1;
  const double cosine = lobe.aim.dot(direction);
  if (lobe.share_back > 0)
    return (cosine > 0 ? 1 - lobe.share_back : lobe.share_back) * std::abs(cosine) /
           std::max(lobe.share_back, 1 - lobe.share_back);
  return cosine > 0 ? std::pow(cosine, lobe.exponent) : 0;
}

}  // namespace

std::vector<Watcher> WatchingViews(const std::vector<SeenPlace>& seen, const std::vector<Watcher>& views) {
  return std::any_of(seen.begin(), seen.end(), IsSure) ? views : std::vector<Watcher>();
}

std::vector<WatchingView> ViewsOf(const Room& room, const std::vector<Watcher>& views,
                                  const Eigen::Vector3d& place) {
  std::vector<WatchingView> watching;
  for (size_t v = 0; v < views.size(); ++v) {
    const Eigen::Vector3d from_eye = place - views[v].eye;
    if (IsInPicture(views[v], from_eye) && !room.rays.Occluded(views[v].eye, place))
      watching.push_back({static_cast<int>(v), -from_eye.normalized()});
  }
  return watching;
}

bool IsRefuted(const Lobe& lobe, const std::vector<WatchingView>& of_place, const std::vector<bool>& counts) {
  return std::count_if(of_place.begin(), of_place.end(), [&](const WatchingView& w) {
           return counts[static_cast<size_t>(w.view)] && ShareOfPeak(lobe, w.direction) > kBright;
         }) >= kEnough;
}

}  // namespace luxfit
