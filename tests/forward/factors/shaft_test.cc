#include "forward/factors/internal/shaft.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "forward/room/visibility.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using Eigen::Vector3d;

struct Pair {
  Facet a, b;
};

// Two plates that face each other across x, seen by each other or not, and a plate somewhere between.
Facet RandomPlate(std::mt19937_64& rng, const Vector3d& around, const Vector3d& towards, double size) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto random = [&] { return Vector3d(uniform(rng), uniform(rng), uniform(rng)); };
  const Vector3d normal = (towards + 0.6 * random()).normalized();
  const Vector3d u = size * (normal.cross(random())).normalized(),
                 v = normal.cross(u) * (0.5 + 0.4 * uniform(rng));
  const FacetKind kind = uniform(rng) > 0 ? FacetKind::kTriangle : FacetKind::kParallelogram;
  return {kind, around + 0.2 * random() - 0.4 * (u + v), u, v, 0};
}

Vector3d PointOn(const Facet& facet, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> uniform(0, 1);
  double u = uniform(rng), v = uniform(rng);
  if (facet.kind == FacetKind::kTriangle && u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return facet.PointAt(u, v);
}

// What the shaft proves must hold for every ray between random points; sampled rays are the judge here.
TEST(Shaft, ProvesWhatRaysFind) {
  std::mt19937_64 rng = support::TestRng();
  int separated = 0, blocked = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Facet a = RandomPlate(rng, {0, 0, 0}, {1, 0, 0}, 0.4),
                b = RandomPlate(rng, {2, 0, 0}, {-1, 0, 0}, 0.4);
    const Facet c = RandomPlate(rng, {1, 0, 0}, {1, 0, 0}, trial % 2 == 0 ? 0.3 : 4);
    const ConvexPolygon pa = MakePolygon(a.origin, a.edge_u, a.edge_v, a.kind);
    const ConvexPolygon pb = MakePolygon(b.origin, b.edge_u, b.edge_v, b.kind);
    const Blocker blocker = BlockersOf({c}).front();
    Shaft shaft(pa, a.Normal(), pb, b.Normal());
    shaft.MakeSides();
    const bool excludes = shaft.ClearlyExcludes(blocker) || shaft.SidesExclude(blocker);
    const bool blocks = shaft.IsBlockedBy(blocker);
    EXPECT_FALSE(excludes && blocks);
    Scene scene;
    scene.materials = {"plate"};
    scene.facets = {c};
    const RayScene rays(scene);
    int hits = 0, seen = 0;
    for (int k = 0; k < 50; ++k) {
      const Vector3d p = PointOn(a, rng), q = PointOn(b, rng);
      if (a.Normal().dot(q - p) < 1e-3 || b.Normal().dot(p - q) < 1e-3) continue;
      ++seen;
      hits += rays.Occluded(p, q) ? 1 : 0;
    }
    if (shaft.FacesAway()) {
      EXPECT_EQ(seen, 0);
    }
    if (excludes) {
      EXPECT_EQ(hits, 0) << trial;
    }
    if (blocks) {
      EXPECT_EQ(hits, seen) << trial;
    }
    separated += excludes ? 1 : 0;
    blocked += blocks ? 1 : 0;
  }
  EXPECT_GT(separated, 100);  // both are really met
  EXPECT_GT(blocked, 100);
}

}  // namespace
}  // namespace luxfit
