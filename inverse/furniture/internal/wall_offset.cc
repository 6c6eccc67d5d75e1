#include "inverse/furniture/internal/wall_offset.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "inverse/select/internal/spatial_blocks.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {
namespace {

constexpr int kBlocks = 40, kFolds = 5;
constexpr int kFewestViewsOfWall = 2;   // the covariance of poses says what two are worth
constexpr int kFewestPairs = 100;       // a place and two views that see it: 1 m2 and more
constexpr double kLeastOffsetM = 0.01;  // less hardly matters to the light
constexpr double kSigmasOff = 3;
constexpr double kFloorM = 0.002;  // of sigma: poses and lenses err alike all over a wall
constexpr double kStandardErrors = 2, kWorthMoving = 0.05;

using Losses = Eigen::Array<double, 1, kOffsets>;

struct Blocks {
  OffsetLosses losses;  // by block
  std::vector<int> pairs;
};

Blocks BlocksOf(const HullPlane& plane, const SweptOffsets& swept) {
  std::vector<Eigen::Vector3d> places;
  std::vector<size_t> cells;
  for (size_t i = 0; i < plane.cells.size(); ++i) {
    if (swept.pairs_of_place[i] == 0) continue;
    places.push_back(plane.cells[i].place);
    cells.push_back(i);
  }
  if (places.empty()) return {};
  const std::vector<int> block = SpatialBlocks(places, kBlocks);
  const int count = *std::max_element(block.begin(), block.end()) + 1;
  Blocks blocks{OffsetLosses::Zero(count, kOffsets), std::vector<int>(static_cast<size_t>(count), 0)};
  for (size_t k = 0; k < cells.size(); ++k) {
    blocks.losses.row(block[k]) += swept.by_place.row(static_cast<Eigen::Index>(cells[k]));
    blocks.pairs[static_cast<size_t>(block[k])] += swept.pairs_of_place[cells[k]];
  }
  return blocks;
}

// Returns where losses are least, in steps from the first offset: between steps by a parabola, at an end the end.
double LeastAt(const Losses& losses) {
  Eigen::Index k = 0;
  losses.minCoeff(&k);
  if (k == 0 || k == kOffsets - 1) return static_cast<double>(k);
  const double curvature = losses[k - 1] - 2 * losses[k] + losses[k + 1];
  return static_cast<double>(k) + (curvature > 0 ? 0.5 * (losses[k - 1] - losses[k + 1]) / curvature : 0);
}

double MetresOf(double steps) { return (steps - kOffsetSteps) * kOffsetStepM; }

// Returns the variance of what LeastAt says, m2, by the jackknife that leaves out groups of unequal size:
// 1 / G sum over groups (n / n_g - 1) (o without g - o)^2. Groups without which little is left do not count.
// Source: Busing, Meijer, van der Leeden (1999).
double JackknifeVariance(const Losses& all, double total, const OffsetLosses& groups,
                         const std::vector<int>& pairs) {
  constexpr double kLargestShare = 0.8;
  double sum = 0;
  int count = 0;
  for (Eigen::Index g = 0; g < groups.rows(); ++g) {
    const int n = pairs[static_cast<size_t>(g)];
    if (n == 0 || n > kLargestShare * total) continue;
    ++count;
    sum +=
        (total / n - 1) * std::pow(MetresOf(LeastAt(all - groups.row(g)) - LeastAt(all) + kOffsetSteps), 2);
  }
  return count > 0 ? sum / count : 0;
}

// Tells whether data left out ask for the offset that the others have.
bool IsAskedFor(const Losses& all, const Blocks& blocks) {
  GroupScores given, moved;
  for (int fold = 0; fold < kFolds; ++fold) {
    Losses others = all;
    for (Eigen::Index b = fold; b < blocks.losses.rows(); b += kFolds) others -= blocks.losses.row(b);
    const auto least = static_cast<Eigen::Index>(std::lround(LeastAt(others)));
    for (Eigen::Index b = fold; b < blocks.losses.rows(); b += kFolds) {
      const int pairs = blocks.pairs[static_cast<size_t>(b)];
      given[static_cast<int>(b)] = {blocks.losses(b, kOffsetSteps), pairs};
      moved[static_cast<int>(b)] = {blocks.losses(b, least), pairs};
    }
  }
  SelectionOptions options;
  options.standard_errors = kStandardErrors;
  options.worth_having = kWorthMoving;
  return SimplestWithinOneStandardError({{given, 0, true}, {moved, 1, true}}, options).chosen == 1;
}

}  // namespace

std::optional<WallOffset> EstimateOffset(const HullPlane& plane, const SweptOffsets& swept) {
  const Blocks blocks = BlocksOf(plane, swept);
  const int pairs = std::accumulate(blocks.pairs.begin(), blocks.pairs.end(), 0);
  if (pairs < kFewestPairs) return std::nullopt;
  const Losses all = blocks.losses.colwise().sum();
  const double at = LeastAt(all);
  const auto step = static_cast<Eigen::Index>(std::lround(at));
  if (step == 0 || step == kOffsets - 1) return std::nullopt;
  WallOffset wall;
  wall.by_m = MetresOf(at);
  if (std::abs(wall.by_m) < kLeastOffsetM) return std::nullopt;
  wall.gain = all[kOffsetSteps] - all[step];
  for (Eigen::Index v = 0; v < swept.by_view.rows(); ++v)
    wall.views += swept.by_view(v, step) < swept.by_view(v, kOffsetSteps) ? 1 : 0;
  if (wall.views < kFewestViewsOfWall) return std::nullopt;
  wall.sigma_m = std::sqrt(JackknifeVariance(all, pairs, blocks.losses, blocks.pairs) +
                           JackknifeVariance(all, pairs, swept.by_view, swept.pairs_of_view) +
                           std::pow(swept.pose_sigma_m, 2) + kFloorM * kFloorM);
  if (std::abs(wall.by_m) < kSigmasOff * wall.sigma_m || !IsAskedFor(all, blocks)) return std::nullopt;
  return wall;
}

}  // namespace luxfit
