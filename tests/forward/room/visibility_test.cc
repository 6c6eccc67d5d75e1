#include "forward/room/visibility.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

class RandomRays {
 public:
  Eigen::Vector3d Inside(const Eigen::AlignedBox3d& box) {
    return box.min() + box.sizes().cwiseProduct(Eigen::Vector3d(unit_(rng_), unit_(rng_), unit_(rng_)));
  }
  Eigen::Vector3d Direction() {
    return Eigen::Vector3d(normal_(rng_), normal_(rng_), normal_(rng_)).normalized();
  }

 private:
  std::mt19937_64 rng_ = support::TestRng();
  std::uniform_real_distribution<double> unit_{0.001, 0.999};
  std::normal_distribution<double> normal_;
};

TEST(RayScene, NothingEscapesFromAClosedRoom) {
  const Scene scene = support::ClosedRoom({6, 4, 2.8});
  const RayScene rays(scene);
  RandomRays random;
  int escaped = 0, back = 0;
  for (int i = 0; i < 100000; ++i) {
    const RayHit hit = rays.Trace(random.Inside(scene.Bounds()), random.Direction());
    escaped += hit.facet < 0;
    back += hit.facet >= 0 && !hit.front;
  }
  EXPECT_EQ(escaped, 0);
  EXPECT_EQ(back, 0);
}

TEST(RayScene, AHitIsWhereTheRayMeetsTheFacet) {
  Scene scene = support::ClosedRoom({6, 4, 2.8});
  support::AddTriangle(scene, {2, 1, 1}, {2, 0.5, 0}, {0.3, 2, 0.6}, "table");
  support::AddParallelogram(scene, {1, 2, 0.5}, {0.7, 0.2, 0.1}, {0, 0.5, 1}, "screen");
  const RayScene rays(scene);
  RandomRays random;
  std::vector<int> hits(scene.facets.size()), fronts(scene.facets.size());
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d origin = random.Inside(scene.Bounds()), direction = 1.7 * random.Direction();
    const RayHit hit = rays.Trace(origin, direction);
    ASSERT_GE(hit.facet, 0);
    const Facet& facet = scene.facets[static_cast<size_t>(hit.facet)];
    // Float coordinates of 6 m have steps of 5e-7 m; a grazing ray enlarges them, a hundredfold in 20000
    // rays.
    EXPECT_LT((facet.PointAt(hit.u, hit.v) - (origin + hit.distance * direction)).norm(), 5e-5);
    EXPECT_EQ(hit.front, direction.dot(facet.Normal()) < 0);
    ++hits[static_cast<size_t>(hit.facet)];
    fronts[static_cast<size_t>(hit.facet)] += hit.front;
  }
  for (size_t f = 0; f < 6; ++f) EXPECT_GT(hits[f], 100) << "wall " << f;
  for (size_t f = 6; f < 8; ++f) {  // things in the room are met from both sides
    EXPECT_GT(fronts[f], 50);
    EXPECT_GT(hits[f] - fronts[f], 50);
  }
}

TEST(RayScene, AWallOccludesFromBothSides) {
  Scene scene;
  support::AddParallelogram(scene, {0, 0, 0}, {0, 2, 0}, {0, 0, 2}, "wall");
  const RayScene rays(scene);
  EXPECT_TRUE(rays.Occluded({-1, 0.9, 1.1}, {1, 1.1, 0.9}));
  EXPECT_TRUE(rays.Occluded({1, 1.1, 0.9}, {-1, 0.9, 1.1}));
  EXPECT_FALSE(rays.Occluded({-1, 2.9, 1.1}, {1, 3.1, 0.9}));   // past its edge
  EXPECT_FALSE(rays.Occluded({-2, 0.9, 1.1}, {-1, 1.1, 0.9}));  // before it
  EXPECT_FALSE(rays.Occluded({1, 0.9, 1.1}, {2, 1.1, 0.9}));    // behind it
}

TEST(RayScene, ThePointsOwnSurfaceDoesNotOcclude) {
  const Scene scene = support::ClosedRoom({4, 3, 2});
  const RayScene rays(scene);
  const Eigen::Vector3d lamp(2, 1.5, 2);  // on the ceiling itself
  EXPECT_FALSE(rays.Occluded(LiftedOff({1.1, 0.7, 0}, {0, 0, 1}), lamp));
  EXPECT_FALSE(rays.Occluded(LiftedOff({0, 0.7, 1.3}, {1, 0, 0}), lamp));
}

TEST(RayScene, AnEmptySceneStopsNothing) {
  const RayScene rays(Scene{});
  EXPECT_EQ(rays.Trace({0, 0, 0}, {0, 0, 1}).facet, -1);
  EXPECT_FALSE(rays.Occluded({0, 0, 0}, {0, 0, 100}));
}

}  // namespace
}  // namespace luxfit
