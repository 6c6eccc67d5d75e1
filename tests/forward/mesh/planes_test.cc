#include "forward/mesh/planes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "forward/mesh/named_planes.h"
#include "forward/room/visibility.h"
#include "tests/support/forward/scan_of.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using Eigen::Vector3d;

const Vector3d kRoom(5, 4, 2.5);

Scene FurnishedScan() {
  Scene scene = support::ClosedRoom(kRoom);
  support::AddBox(scene, {Vector3d(1, 1, 0.7), Vector3d(2.6, 1.8, 0.74)}, support::Facing::kOutward,
                  {"desk"});
  return scene;
}

Scene ScanOfRoom(const support::ScanOptions& options = {}) {
  std::mt19937_64 rng(3);
  return support::ScanOf(FurnishedScan(), options, rng);
}

// The triangles of a scene's facets without any displacement.
Scene Triangulated(const Scene& scene) {
  support::ScanOptions exact;
  exact.edge_m = 0.1;
  exact.bump_m = exact.jitter_m = exact.hole_share = 0;
  std::mt19937_64 rng(1);
  return support::ScanOf(scene, exact, rng);
}

double CoveredM2(const Scene& scene) {
  double area_m2 = 0;
  for (const Facet& facet : SurfaceFacets(scene)) area_m2 += facet.AreaM2();
  return area_m2;
}

// The normals of a room's inner faces and of its distances from the origin, to be found among planes.
void ExpectShell(const Scene& scene, double within_m, double within_rad) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double at : {0.0, kRoom[axis]}) {
      const Vector3d inward = (at == 0 ? 1 : -1) * Vector3d::Unit(axis);
      const auto fits = [&](const Facet& f) {
        return f.AreaM2() > 5 && std::acos(std::min(1.0, f.Normal().dot(inward))) < within_rad &&
               std::abs(f.PointAt(0.5, 0.5)[axis] - at) < within_m;
      };
      EXPECT_EQ(std::count_if(scene.facets.begin(), scene.facets.end(), fits), 1)
          << "axis " << axis << " at " << at;
    }
  }
}

TEST(LayOnPlanes, ExactTrianglesBecomeTheFacesTheyTile) {
  const Scene mesh = Triangulated(FurnishedScan());
  const OnPlanes laid = LayOnPlanes(mesh);
  EXPECT_EQ(laid.how.triangles, static_cast<int>(mesh.facets.size()));
  EXPECT_EQ(laid.how.closed_holes, 0);
  EXPECT_LT(laid.how.rms_m, 1e-9);
  EXPECT_EQ(laid.scene.facets.size(), 12U);
  for (const Facet& facet : laid.scene.facets) EXPECT_NEAR(facet.covered_share, 1, 1e-9);
  ExpectShell(laid.scene, 1e-9, 1e-6);
}

// Bumps of 5 mm and jitter of 2 mm average out: the planes of the walls are right to 1.5 mm and 0.1 degrees.
TEST(LayOnPlanes, ErrorsOfAScanAverageOut) {
  const OnPlanes laid = LayOnPlanes(ScanOfRoom());
  EXPECT_GT(laid.how.triangles, 10000);
  EXPECT_GT(laid.how.closed_holes, 3);
  EXPECT_GT(laid.how.rms_m, 0.003);
  EXPECT_LT(laid.how.rms_m, 0.008);
  EXPECT_LT(laid.scene.facets.size(), 100U);
  ExpectShell(laid.scene, 0.0015, 0.0018);
  EXPECT_NEAR(CoveredM2(laid.scene), CoveredM2(FurnishedScan()), 0.01 * CoveredM2(FurnishedScan()));
}

TEST(LayOnPlanes, TheScanStaysClosed) {
  const Scene scene = LayOnPlanes(ScanOfRoom()).scene;
  const RayScene rays(scene);
  std::mt19937_64 rng(5);
  std::normal_distribution<double> normal;
  constexpr int kRays = 20000;
  int lost = 0;
  for (int k = 0; k < kRays; ++k) {
    const Vector3d direction(normal(rng), normal(rng), normal(rng));
    const RayHit hit = rays.Trace({2.2, 3.1, 1.3}, direction);
    lost += hit.facet < 0 || !hit.front ? 1 : 0;
  }
  EXPECT_LT(lost, kRays / 500);
}

// A ray meets the triangle; its facet's coordinates name the same point.
TEST(LayOnPlanes, HitsHaveThePlaceOnTheirFacet) {
  const Scene scene = LayOnPlanes(ScanOfRoom()).scene;
  const RayScene rays(scene);
  std::mt19937_64 rng(7);
  std::normal_distribution<double> normal;
  const Vector3d from(2.2, 3.1, 1.3);
  RayPacket packet;
  std::vector<RayHit> hits;
  for (int k = 0; k < RayPacket::kSize; ++k) {
    const Vector3d direction = Vector3d(normal(rng), normal(rng), normal(rng)).normalized();
    hits.push_back(rays.Trace(from, direction));
    ASSERT_GE(hits.back().facet, 0);
    const Facet& facet = scene.facets[static_cast<size_t>(hits.back().facet)];
    EXPECT_LT((facet.PointAt(hits.back().u, hits.back().v) - from - hits.back().distance * direction).norm(),
              1e-5);
    packet.Add(from.cast<float>(), direction.cast<float>());
  }
  const PacketHits together = rays.Trace(packet);
  for (int k = 0; k < RayPacket::kSize; ++k) {
    const RayHit& single = hits[static_cast<size_t>(k)];
    EXPECT_EQ(together.facet[k], single.facet);
    EXPECT_NEAR(together.u[k], single.u, 1e-5);
    EXPECT_NEAR(together.v[k], single.v, 1e-5);
  }
}

TEST(LayOnPlanes, MaterialsAreNamedByWhatPlanesAre) {
  PlanesOptions options;
  options.named_material = kDefaultMaterial;
  const Scene scene = LayOnPlanes(ScanOfRoom(), options).scene;
  const std::set<std::string> names(scene.materials.begin(), scene.materials.end());
  for (const char* name : {"floor", "ceiling", "wall 1", "wall 4", "surface 1", "surface 2", "details 1"})
    EXPECT_EQ(names.count(name), 1U) << name;
  EXPECT_EQ(names.count("wall 5"), 0U);
  EXPECT_TRUE(AreNamedPlanes(scene));
  EXPECT_EQ(LayOnPlanes(ScanOfRoom()).scene.materials, std::vector<std::string>{kDefaultMaterial});
}

// A drawn room of one material, with a box that photos showed.
TEST(NamedPlanes, OfADrawnMeshAreItsFacets) {
  Scene drawn = FurnishedScan();
  for (Facet& facet : drawn.facets) facet.material = 0;
  drawn.materials = {"paint"};
  support::AddBox(drawn, {Vector3d(3, 2, 0), Vector3d(3.6, 2.4, 1)}, support::Facing::kOutward, {"found 1"});
  ASSERT_EQ(SoleMaterialOf(drawn), "paint");
  const Scene named = WithPlanesNamed(drawn, "paint");
  EXPECT_THAT(named.materials,
              testing::UnorderedElementsAre("floor", "ceiling", "wall 1", "wall 2", "wall 3", "wall 4",
                                            "surface 1", "surface 2", "details 1", "found 1"));
  ASSERT_EQ(named.facets.size(), drawn.facets.size());
  for (const Facet& facet : named.facets) {
    const std::string& name = named.materials[static_cast<size_t>(facet.material)];
    const Vector3d normal = facet.Normal();
    if (name == "floor") {
      EXPECT_GT(normal.z(), 0.99);
    }
    if (name == "ceiling") {
      EXPECT_LT(normal.z(), -0.99);
    }
    if (name.rfind("wall", 0) == 0) {
      EXPECT_GT(facet.AreaM2(), 9);
    }
    if (name == "details 1") {
      EXPECT_LT(facet.AreaM2(), 0.3);
    }
  }
  for (size_t f = drawn.facets.size() - 6; f < drawn.facets.size(); ++f)
    EXPECT_EQ(named.materials[static_cast<size_t>(named.facets[f].material)], "found 1");
  EXPECT_TRUE(AreNamedPlanes(named));
}

TEST(NamedPlanes, SeveralMaterialsStay) {
  const Scene furnished = FurnishedScan();
  EXPECT_EQ(SoleMaterialOf(furnished), "");
  EXPECT_EQ(WithPlanesNamed(furnished, "").materials, furnished.materials);
}

TEST(NamedPlanes, AreNumberedInOrder) {
  Scene scene;
  scene.materials = {"floor", "wall 1", "floor 2", "wall 2", "details 1", "found 1"};
  EXPECT_TRUE(AreNamedPlanes(scene));
  for (const char* other : {"wall", "wall 4", "floor", "carpet", "DefaultMaterial"}) {
    Scene unlike = scene;
    unlike.materials.emplace_back(other);
    EXPECT_FALSE(AreNamedPlanes(unlike)) << other;
  }
}

TEST(LayOnPlanes, MaterialsOfTheMeshBoundPlanes) {
  Scene mesh = support::ClosedRoom(kRoom);
  mesh.materials.push_back("rug");
  mesh = Triangulated(mesh);
  mesh.materials = {"wall", "rug"};
  for (Facet& facet : mesh.facets) {
    if (facet.Normal().z() > 0.5 && facet.origin.x() < 2) facet.material = 1;
  }
  const Scene scene = LayOnPlanes(mesh).scene;
  EXPECT_EQ(scene.materials, mesh.materials);
  EXPECT_FALSE(AreNamedPlanes(scene));
  double rug_m2 = 0, all_m2 = 0;
  for (const Facet& facet : scene.facets) {
    if (facet.Normal().z() < 0.5) continue;
    all_m2 += facet.AreaM2();
    rug_m2 += facet.material == 1 ? facet.AreaM2() : 0;
  }
  EXPECT_NEAR(all_m2, kRoom.x() * kRoom.y(), 1e-6);
  EXPECT_NEAR(rug_m2, 8, 0.5);
}

// An L-shaped floor fills five eighths of its rectangle: elements lie on the floor alone, and their areas add up.
TEST(LayOnPlanes, ElementsLieWhereTheSurfaceIs) {
  Scene scene;
  support::AddParallelogram(scene, {0, 0, 0}, {4, 0, 0}, {0, 1, 0}, "floor");
  support::AddParallelogram(scene, {0, 1, 0}, {1.5, 0, 0}, {0, 2, 0}, "floor");
  const Scene laid = LayOnPlanes(Triangulated(scene)).scene;
  ASSERT_EQ(laid.facets.size(), 1U);
  EXPECT_NEAR(laid.facets[0].covered_share, 7.0 / 12, 1e-6);
  const RayScene rays(laid);
  const Patches patches = Subdivide(laid, rays);
  double elements_m2 = 0, patches_m2 = 0;
  for (const Element& element : patches.elements) {
    elements_m2 += element.area_m2;
    EXPECT_TRUE(element.center.y() < 1 || element.center.x() < 1.5) << element.center.transpose();
    EXPECT_NEAR(element.edge_u.cross(element.edge_v).norm(), element.area_m2, 1e-9);
  }
  for (const Patch& patch : patches.patches) patches_m2 += patch.area_m2;
  EXPECT_NEAR(elements_m2, 7, 1e-6);
  EXPECT_NEAR(patches_m2, 7, 1e-6);
  for (const Vector3d& p : {Vector3d(0.2, 2.9, 0), Vector3d(3.9, 0.95, 0), Vector3d(1.45, 1.2, 0)}) {
    const Eigen::Vector2d at = laid.facets[0].CoordinatesOf(p);
    EXPECT_GE(patches.ElementAt(0, at.x(), at.y()), 0) << p.transpose();
  }
  const Eigen::Vector2d off = laid.facets[0].CoordinatesOf({3, 2, 0});
  EXPECT_EQ(patches.ElementAt(0, off.x(), off.y()), -1);
}

TEST(LayOnPlanes, LargeOpeningsStayOpen) {
  Scene scene = support::ClosedRoom(kRoom);
  scene.facets.pop_back();  // no ceiling
  EXPECT_EQ(LayOnPlanes(Triangulated(scene)).how.closed_holes, 0);
}

TEST(LayOnPlanes, ManySmallPlanesAreLaidOntoCoarserOnes) {
  std::mt19937_64 rng(9);
  support::ScanOptions rough;
  rough.jitter_m = 0.012;
  PlanesOptions options;
  options.off_plane_m = 0.01;
  options.most_planes = 200;
  EXPECT_LE(LayOnPlanes(support::ScanOf(FurnishedScan(), rough, rng), options).scene.facets.size(), 200U);
}

TEST(IsFinerThanPatches, ScansAreAndDrawnRoomsAreNot) {
  EXPECT_FALSE(IsFinerThanPatches(FurnishedScan(), {}));
  EXPECT_TRUE(IsFinerThanPatches(ScanOfRoom(), {}));
}

}  // namespace
}  // namespace luxfit
