#include "inverse/furniture/internal/faces/refine_face.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace luxfit {
namespace {

constexpr double kRefinedCellM = 0.02, kRefinedStepM = 0.01, kMarginM = 0.12;
constexpr double kAsWell = 0.97;
constexpr double kBlurPx = 1.5;

struct Offsets {
  double mean = 0, sigma = 0;  // in steps
};

// Returns where sums are as large as the largest one.
Offsets BestOffsets(const std::vector<VoteRectangle>& best, int most) {
  double sum = 0, squares = 0;
  int count = 0;
  for (size_t i = 0; i < best.size(); ++i) {
    if (best[i].sum < kAsWell * most) continue;
    const auto k = static_cast<double>(i);
    sum += k, squares += k * k, ++count;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) + 1.0 / 12)};
}

std::uint64_t ViewsOf(const PlaneVotes& votes, const VoteRectangle& r) {
  std::uint64_t views = 0;
  const Eigen::Index columns = votes.votes.cols();
  for (Eigen::Index row = r.row; row < r.row + r.rows; ++row)
    for (Eigen::Index column = r.column; column < r.column + r.columns; ++column)
      views |= votes.views[static_cast<size_t>(row * columns + column)];
  return views;
}

// Returns the median size of the views' pixels at a place, m.
double PixelM(const SweptViews& swept, const Eigen::Vector3d& place, std::uint64_t views) {
  std::vector<double> pixel_m;
  for (size_t v = 0; v < swept.views.size() && v < kMostViews; ++v) {
    if ((views >> v & 1U) != 0)
      pixel_m.push_back((swept.eyes[v] - place).norm() / swept.views[v].pixel_from_ray(0, 0));
  }
  if (pixel_m.empty()) return 0;
  const auto middle = pixel_m.begin() + static_cast<std::ptrdiff_t>(pixel_m.size() / 2);
  std::nth_element(pixel_m.begin(), middle, pixel_m.end());
  return *middle;
}

// Grows a flat region within the room, but not along its normal.
Eigen::AlignedBox3d Grown(const Eigen::AlignedBox3d& region, int axis, double by_m, const RoomAxes& axes) {
  Eigen::Vector3d margin = Eigen::Vector3d::Constant(by_m);
  margin[axis] = 0;
  Eigen::AlignedBox3d grown(region.min() - margin, region.max() + margin);
  for (int i = 0; i < 3; ++i) {
    if (i == axis) continue;
    grown.min()[i] = std::max(grown.min()[i], axes.bounds.min()[i]);
    grown.max()[i] = std::min(grown.max()[i], axes.bounds.max()[i]);
  }
  return grown;
}

}  // namespace

std::optional<Face> RefineFace(const SweptViews& swept, const RoomAxes& axes, const Face& face,
                               double least_m2) {
  const int axis = face.facing.axis;
  Eigen::AlignedBox3d first = Grown(face.region, axis, kMarginM, axes);
  first.min()[axis] = first.max()[axis] = face.OffsetM() - kRefinedDepthM;
  const auto at = [&](double steps) {
    Eigen::AlignedBox3d region = first;
    region.min()[axis] = region.max()[axis] = first.min()[axis] + steps * kRefinedStepM;
    return region;
  };
  const auto count = static_cast<size_t>(2 * std::lround(kRefinedDepthM / kRefinedStepM) + 1);
  std::vector<PlaneVotes> votes(count);
  std::vector<VoteRectangle> best(count);
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    votes[i] = Sweep(swept, PlaneOf(axes, face.facing, at(static_cast<double>(i)), kRefinedCellM));
    best[i] = FindLargestRectangle(votes[i].votes);
  });
  int most = 0;
  for (const VoteRectangle& r : best) most = std::max(most, r.sum);
  if (kRefinedCellM * kRefinedCellM * most < least_m2) return std::nullopt;
  const Offsets offsets = BestOffsets(best, most);
  const auto nearest = static_cast<size_t>(std::lround(offsets.mean));
  Face fine = face;
  fine.region = RegionOf(face.facing, at(offsets.mean), kRefinedCellM, best[nearest]);
  fine.sigma_m = kRefinedStepM * offsets.sigma;
  fine.area_m2 = kRefinedCellM * kRefinedCellM * best[nearest].sum;
  fine.views = ViewsOf(votes[nearest], best[nearest]);
  const double pixel_m = PixelM(swept, axes.world_from_axes * fine.region.center(), fine.views);
  fine.region = Grown(fine.region, axis, kBlurPx * pixel_m, axes);
  return fine;
}

}  // namespace luxfit
