#include "forward/room/patches.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr double kRoundOff = 1e-9;  // of doubles summed over some thousand elements

// One sheared parallelogram and one scalene triangle, side by side.
Scene TwoKinds() {
  Scene scene;
  support::AddParallelogram(scene, {0, 0, 0}, {2.3, 0, 0}, {0.4, 1.7, 0.2}, "floor");
  support::AddTriangle(scene, {5, 0, 0}, {1.9, 0.3, 0}, {0.2, 1.4, 0.5}, "wall");
  return scene;
}

Patches SubdivisionOf(const Scene& scene, const PatchesOptions& options = {}) {
  return Subdivide(scene, RayScene(scene), options);
}

TEST(Subdivide, AreasAddUpToTheFacets) {
  const Scene scene = TwoKinds();
  const Patches patches = SubdivisionOf(scene);
  std::vector<double> of_patches(scene.facets.size()), of_elements(scene.facets.size());
  for (const Patch& patch : patches.patches) of_patches[static_cast<size_t>(patch.facet)] += patch.area_m2;
  for (const Element& element : patches.elements) {
    const Patch& patch = patches.patches[static_cast<size_t>(element.patch)];
    of_elements[static_cast<size_t>(patch.facet)] += element.area_m2;
  }
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    EXPECT_NEAR(of_patches[f], scene.facets[f].AreaM2(), kRoundOff);
    EXPECT_NEAR(of_elements[f], scene.facets[f].AreaM2(), kRoundOff);
  }
}

TEST(Subdivide, ElementsOfAPatchAreConsecutiveAndMakeItsAreaAndCentre) {
  const Scene scene = TwoKinds();
  const Patches patches = SubdivisionOf(scene);
  int next = 0;
  for (size_t p = 0; p < patches.patches.size(); ++p) {
    const Patch& patch = patches.patches[p];
    EXPECT_EQ(patch.first_element, next);
    EXPECT_EQ(patch.material, scene.facets[static_cast<size_t>(patch.facet)].material);
    double area = 0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (int e = 0; e < patch.element_count; ++e, ++next) {
      const Element& element = patches.elements[static_cast<size_t>(next)];
      EXPECT_EQ(element.patch, static_cast<int>(p));
      area += element.area_m2;
      moment += element.area_m2 * element.center;
    }
    EXPECT_NEAR(patch.area_m2, area, kRoundOff);
    EXPECT_NEAR((patch.center - moment / area).norm(), 0, kRoundOff);
  }
  EXPECT_EQ(next, static_cast<int>(patches.elements.size()));
}

TEST(Subdivide, NothingIsLargerThanAskedFor) {
  const PatchesOptions options{0.5, 0.15};
  const Scene scene = TwoKinds();
  const Patches patches = SubdivisionOf(scene, options);
  for (const Element& element : patches.elements) {
    EXPECT_LE(element.edge_u.norm(), options.element_size_m + kRoundOff);
    EXPECT_LE(element.edge_v.norm(), options.element_size_m + kRoundOff);
    const Patch& patch = patches.patches[static_cast<size_t>(element.patch)];
    // Within half the patch's longest diagonal (two edges' lengths) of its centre.
    EXPECT_LE((element.center - patch.center).norm(), options.patch_size_m);
    EXPECT_NEAR((element.normal - scene.facets[static_cast<size_t>(patch.facet)].Normal()).norm(), 0,
                kRoundOff);
  }
}

// Coordinates of a point in an element's own frame of edges.
Eigen::Vector2d InElement(const Element& element, const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 3, 2> edges;
  edges << element.edge_u, element.edge_v;
  return (edges.transpose() * edges).inverse() * edges.transpose() * (p - element.origin);
}

TEST(ElementAt, ContainsThePoint) {
  const Scene scene = TwoKinds();
  const Patches patches = SubdivisionOf(scene);
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const int facet = i % 2;
    const bool triangle = scene.facets[static_cast<size_t>(facet)].kind == FacetKind::kTriangle;
    Eigen::Vector2d uv(unit(rng), unit(rng));
    if (triangle && uv.sum() > 1) uv = Eigen::Vector2d::Ones() - uv;
    const int index = patches.ElementAt(facet, uv[0], uv[1]);
    ASSERT_GE(index, 0);
    const Element& element = patches.elements[static_cast<size_t>(index)];
    EXPECT_EQ(patches.patches[static_cast<size_t>(element.patch)].facet, facet);
    const Eigen::Vector2d st =
        InElement(element, scene.facets[static_cast<size_t>(facet)].PointAt(uv[0], uv[1]));
    EXPECT_GE(st.minCoeff(), -kRoundOff);
    EXPECT_LE(triangle ? st.sum() : st.maxCoeff(), 1 + kRoundOff);
  }
}

TEST(ElementAt, TakesTheFacetsCorners) {
  const Patches patches = SubdivisionOf(TwoKinds());
  for (const auto& [u, v] : {std::pair{0., 0.}, {1., 0.}, {0., 1.}}) {
    EXPECT_GE(patches.ElementAt(0, u, v), 0);
    EXPECT_GE(patches.ElementAt(1, u, v), 0);
  }
  EXPECT_GE(patches.ElementAt(0, 1, 1), 0);
}

// Free area of a 4 x 4 m floor on which an upright box stands, its bottom in the floor's plane.
double FloorAreaRoundBox(const Eigen::AlignedBox3d& box, const PatchesOptions& options,
                         Patches* patches = nullptr) {
  Scene scene;
  support::AddParallelogram(scene, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, "floor");
  support::AddBox(scene, box, support::Facing::kOutward, {"box"});
  const Patches result = SubdivisionOf(scene, options);
  double area = 0;
  for (const Patch& patch : result.patches) area += patch.facet == 0 ? patch.area_m2 : 0;
  if (patches != nullptr) *patches = result;
  return area;
}

TEST(Subdivide, LeavesOutTheFloorUnderABoxOnTheGrid) {
  Patches patches;
  const Eigen::AlignedBox3d box(Eigen::Vector3d(1, 1.5, 0), Eigen::Vector3d(2, 3, 0.8));
  EXPECT_NEAR(FloorAreaRoundBox(box, {0.5, 0.1}, &patches), 16 - 1.5, kRoundOff);
  EXPECT_EQ(patches.ElementAt(0, 1.55 / 4, 2.05 / 4), -1);
  EXPECT_GE(patches.ElementAt(0, 0.55 / 4, 2.05 / 4), 0);
}

TEST(Subdivide, ElementsPartlyUnderABoxKeepTheirFreeShare) {
  const PatchesOptions options{0.5, 0.1};
  const Eigen::AlignedBox3d box(Eigen::Vector3d(1.03, 1.46, 0), Eigen::Vector3d(2.07, 3.012, 0.8));
  const Eigen::Vector2d footprint = box.sizes().head<2>();
  // Each element is probed on 4 x 4 points, so an edge of the box is misplaced by at most a probe's distance.
  const double tolerance = 2 * footprint.sum() * options.element_size_m / 4;
  EXPECT_NEAR(FloorAreaRoundBox(box, options), 16 - footprint.prod(), tolerance);
}

// Areas by facet of the room's scene.
Eigen::VectorXd FreeAreas(const Scene& scene, const PatchesOptions& options) {
  const Patches patches = SubdivisionOf(scene, options);
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(scene.facets.size()));
  for (const Patch& patch : patches.patches) areas[patch.facet] += patch.area_m2;
  return areas;
}

TEST(Subdivide, NothingLiesInsideASingleSheet) {
  Scene scene = support::ClosedRoom({4, 3, 2.5});
  // A partition that faces +x, a shelf that faces up 0.3 m above the floor, and a table top.
  support::AddParallelogram(scene, {2, 0, 0}, {0, 2, 0}, {0, 0, 2.2}, "sheet");
  support::AddParallelogram(scene, {3, 2.7, 0.3}, {0.9, 0, 0}, {0, 0.3, 0}, "sheet");
  support::AddParallelogram(scene, {2.4, 0.5, 0.74}, {1.4, 0, 0}, {0, 0.8, 0}, "sheet");
  const Eigen::VectorXd areas = FreeAreas(scene, {0.5, 0.1});
  for (size_t f = 0; f < scene.facets.size(); ++f)
    EXPECT_NEAR(areas[static_cast<Eigen::Index>(f)], scene.facets[f].AreaM2(), kRoundOff) << f;
}

TEST(Subdivide, WhatStandsInASolidDoesNotOpenIt) {
  Scene scene = support::ClosedRoom({4, 3, 2.5});
  support::AddBox(scene, {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(2, 2, 2)}, support::Facing::kOutward,
                  {"cabinet"});
  support::AddBox(scene, {Eigen::Vector3d(1.4, 1.4, 0), Eigen::Vector3d(1.6, 1.6, 0.3)},
                  support::Facing::kOutward, {"pipe"});
  EXPECT_NEAR(FreeAreas(scene, {0.5, 0.1})[4], 12 - 1, kRoundOff);  // of the floor
}

TEST(Subdivide, RefusesSizesThatMakeNoSense) {
  const Scene scene = TwoKinds();
  EXPECT_THROW(SubdivisionOf(scene, {0.4, 0}), std::invalid_argument);
  EXPECT_THROW(SubdivisionOf(scene, {0.4, -0.1}), std::invalid_argument);
  EXPECT_THROW(SubdivisionOf(scene, {0.1, 0.2}), std::invalid_argument);
  EXPECT_THROW(SubdivisionOf(scene, {std::nan(""), 0.1}), std::invalid_argument);
  EXPECT_THROW(SubdivisionOf(scene, {0.4, std::nan("")}), std::invalid_argument);
}

TEST(Subdivide, AnEmptySceneHasNoPatches) {
  EXPECT_TRUE(SubdivisionOf(Scene{}).patches.empty());
  EXPECT_TRUE(SubdivisionOf(Scene{}).elements.empty());
}

}  // namespace
}  // namespace luxfit
