#include "forward/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "tests/support/scenes.h"
#include "tests/support/temp_folder.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

// Coordinates pass through the reader as floats: 1e-6 of the largest, 3 m.
constexpr double kFloatM = 3e-6;

// A 3 x 2 m floor and a 2 x 1 m wall beside it.
constexpr char kTwoQuads[] =
    "mtllib room.mtl\n"
    "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\n"
    "v 0 0 1\nv 0 2 1\n"
    "usemtl floor\nf 1 2 3 4\n"
    "usemtl wall\nf 1 4 6 5\n";
constexpr char kMaterials[] = "newmtl floor\nKd 0.5 0.5 0.5\nnewmtl wall\nKd 0.5 0.5 0.5\n";

Scene SceneOf(const std::string& obj, double metres_per_unit = 1) {
  const TempFolder folder;
  folder.Write("room.obj", obj);
  folder.Write("room.mtl", kMaterials);
  return ReadScene(folder.Path("room.obj"), metres_per_unit);
}

TEST(ReadScene, RectanglesStayWholeAndKeepTheirMaterial) {
  const Scene scene = SceneOf(kTwoQuads);
  ASSERT_EQ(scene.facets.size(), 2u);
  for (const Facet& facet : scene.facets) {
    EXPECT_EQ(facet.kind, FacetKind::kParallelogram);
    const bool floor = scene.materials[static_cast<size_t>(facet.material)] == "floor";
    EXPECT_TRUE(floor || scene.materials[static_cast<size_t>(facet.material)] == "wall");
    EXPECT_NEAR(facet.AreaM2(), floor ? 6 : 2, 6 * kFloatM);
    const Eigen::Vector3d normal = floor ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    EXPECT_NEAR((facet.Normal() - normal).norm(), 0, kFloatM) << facet.Normal().transpose();
  }
  EXPECT_NE(scene.facets[0].material, scene.facets[1].material);
  EXPECT_EQ(scene.dropped_facets, 0);
}

TEST(ReadScene, LengthsAreScaledToMetres) {
  const Scene scene = SceneOf(kTwoQuads, 0.01);
  EXPECT_NEAR((scene.Bounds().min() - Eigen::Vector3d::Zero()).norm(), 0, kFloatM);
  EXPECT_NEAR((scene.Bounds().max() - Eigen::Vector3d(0.03, 0.02, 0.01)).norm(), 0, kFloatM);
}

TEST(ReadScene, AConcavePolygonBecomesTrianglesOfItsAreaAndNormal) {
  // An L: a 2 x 2 square without its 1 x 1 upper right quarter, so 3 m2. A fan from the first corner would
  // cover 4.
  const Scene scene =
      SceneOf("usemtl floor\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n");
  double area = 0;
  for (const Facet& facet : scene.facets) {
    EXPECT_EQ(facet.kind, FacetKind::kTriangle);
    EXPECT_NEAR((facet.Normal() - Eigen::Vector3d::UnitZ()).norm(), 0, kFloatM);
    EXPECT_FALSE(facet.PointAt(1. / 3, 1. / 3).x() > 1 && facet.PointAt(1. / 3, 1. / 3).y() > 1);
    area += facet.AreaM2();
  }
  EXPECT_EQ(scene.facets.size(), 4u);  // a polygon of n corners has n - 2 triangles
  EXPECT_NEAR(area, 3, 4 * kFloatM);
}

TEST(ReadScene, FacesWithoutAreaAreCounted) {
  const Scene scene = SceneOf(std::string(kTwoQuads) + "v 1 0 0\nv 2 0 0\nf 1 7 8\n");
  EXPECT_EQ(scene.dropped_facets, 1);
  EXPECT_EQ(scene.facets.size(), 2u);
}

std::string ErrorOf(const std::string& path) {
  try {
    ReadScene(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ReadScene, AMissingFileIsNamed) {
  const std::string path = TempFolder().Path("nowhere.obj");
  EXPECT_NE(ErrorOf(path).find(path), std::string::npos) << ErrorOf(path);
}

TEST(ReadScene, AFileWithoutFacetsIsNamed) {
  const TempFolder folder;
  folder.Write("points.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\n");
  folder.Write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  folder.Write("text.obj", "this is no mesh\n");
  for (const char* name : {"points.obj", "line.obj", "text.obj"}) {
    const std::string path = folder.Path(name);
    EXPECT_NE(ErrorOf(path).find(path), std::string::npos) << ErrorOf(path);
  }
}

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
