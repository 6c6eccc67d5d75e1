#include "calib/calibrate/internal/calibration_fit.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <vector>

#include "tests/support/calib/board_views.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::BoardViewsOptions;
using support::OpenCv8Camera;
using support::TestRng;

constexpr int kSpoiltSet = 3;

// The five or fewer corners of a set that lie outermost and in its middle: enough for a pose, without a margin.
std::set<std::size_t> FewCornersOf(const CalibrationProblem& problem, int set) {
  Eigen::Vector2d middle(0, 0);
  int count = 0;
  for (const CornerObservation& corner : problem.corners) {
    if (corner.set != set) continue;
    middle += corner.pixel;
    ++count;
  }
  middle /= count;
  const std::vector<std::function<double(const Eigen::Vector2d&)>> heights = {
      [](const Eigen::Vector2d& p) { return p.x() + p.y(); },
      [](const Eigen::Vector2d& p) { return p.x() - p.y(); },
      [](const Eigen::Vector2d& p) { return -p.x() + p.y(); },
      [](const Eigen::Vector2d& p) { return -p.x() - p.y(); },
      [&](const Eigen::Vector2d& p) { return -(p - middle).norm(); }};
  std::set<std::size_t> few;
  for (const auto& height : heights) {
    std::size_t best = problem.corners.size();
    for (std::size_t k = 0; k < problem.corners.size(); ++k) {
      if (problem.corners[k].set != set) continue;
      if (best == problem.corners.size() ||
          height(problem.corners[k].pixel) > height(problem.corners[best].pixel))
        best = k;
    }
    few.insert(best);
  }
  return few;
}

TEST(CalibrationFit, ASetThatKeepsTooFewCornersForAPoseIsLeftOutWhole) {
  auto rng = TestRng();
  BoardViewsOptions views;
  views.images = 10;
  const CalibrationInput input = support::ViewsOf(OpenCv8Camera(), views, rng);
  CalibrationProblem problem = MakeProblem(input);
  const CalibrationSeed seed = SeedCalibration(problem, 0);
  ASSERT_TRUE(seed.ok) << seed.message;
  const LensFit whole = FitLens(problem, seed, {LensModel::kOpenCv, 8, 0}, nullptr, {});
  ASSERT_TRUE(whole.ok) << whole.message;
  const std::set<std::size_t> few = FewCornersOf(problem, kSpoiltSet);
  ASSERT_GE(few.size(), 4U);
  for (std::size_t k = 0; k < problem.corners.size(); ++k) {
    CornerObservation& corner = problem.corners[k];
    if (corner.set != kSpoiltSet || few.count(k) > 0) continue;
    corner.pixel.x() += k % 2 == 0 ? 20 : -20;
    corner.used = false;
  }
  const LensFit fit = FitFrom(problem, whole.state, {});
  ASSERT_TRUE(fit.ok) << fit.message;
  std::vector<int> used(static_cast<std::size_t>(problem.sets), 0);
  for (std::size_t k = 0; k < problem.corners.size(); ++k)
    used[static_cast<std::size_t>(problem.corners[k].set)] += fit.used[k] ? 1 : 0;
  for (int set = 0; set < problem.sets; ++set) {
    if (set == kSpoiltSet) {
      EXPECT_EQ(used[static_cast<std::size_t>(set)], 0);
    } else {
      EXPECT_GT(used[static_cast<std::size_t>(set)], 30) << "boards show 44 corners and more: set " << set;
    }
  }
  // The other nine sets have some 1500 rows: their noise is known to 2 %.
  EXPECT_NEAR(fit.noise_px, views.noise_px, 0.06 * views.noise_px);
}

}  // namespace
}  // namespace luxfit
