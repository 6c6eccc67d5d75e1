#include "forward/room/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

TEST(DistanceToSurface, OfARectangleIsExact) {
  Scene scene;
  support::AddParallelogram(scene, {1, 1, 0.5}, {2, 0, 0}, {0, 1, 0}, "floor");
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> coordinate(-1, 4);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p(coordinate(rng), coordinate(rng), coordinate(rng));
    const double dx = std::max({1 - p.x(), 0., p.x() - 3}), dy = std::max({1 - p.y(), 0., p.y() - 2});
    const double expected = Eigen::Vector3d(dx, dy, p.z() - 0.5).norm();
    EXPECT_NEAR(DistanceToSurface(scene, p), expected, 1e-12);  // double rounding
  }
}

TEST(DistanceToSurface, TakesTheNearestFacet) {
  EXPECT_NEAR(DistanceToSurface(support::ClosedRoom({4, 3, 2}), {3.9, 1.5, 1}), 0.1,
              1e-12);  // double rounding
  EXPECT_EQ(DistanceToSurface(Scene{}, {0, 0, 0}), std::numeric_limits<double>::infinity());
}

TEST(DistanceToSurface, OfATriangleReachesItsSides) {
  Scene scene;
  support::AddTriangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, "floor");
  EXPECT_NEAR(DistanceToSurface(scene, {0.2, 0.2, 0.3}), 0.3, 1e-12);  // double rounding, here and below
  EXPECT_NEAR(DistanceToSurface(scene, {1, 1, 0}), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(DistanceToSurface(scene, {-1, -1, 0}), std::sqrt(2), 1e-12);
}

TEST(Bounds, HoldEveryCornerAndNothingElse) {
  Scene scene;
  support::AddTriangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 2, 0}, "floor");
  EXPECT_TRUE(
      scene.Bounds().isApprox(Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 2, 0))));
  support::AddParallelogram(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 3}, "wall");
  EXPECT_TRUE(
      scene.Bounds().isApprox(Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, 2, 3))));
  EXPECT_TRUE(Scene{}.Bounds().isEmpty());
}

}  // namespace
}  // namespace luxfit
