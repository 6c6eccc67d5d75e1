#include "forward/changes/painted_rectangles.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "forward/mesh/outline.h"

namespace luxfit {
namespace {

Scene Box() { return SceneFrom(OutlineOfBox({6, 4, 2.8})); }

// On the wall y = 0, whose front faces +y.
const PaintedRectangle kWindow{"window", {4, 0, 1}, {-2, 0, 0}, {0, 0, 1.5}};

std::map<std::string, double> AreasOf(const Scene& scene) {
  std::map<std::string, double> areas;
  for (const Facet& facet : scene.facets)
    areas[scene.materials[static_cast<size_t>(facet.material)]] += facet.AreaM2();
  return areas;
}

TEST(PaintedRectangles, AreCutOutOfTheirWall) {
  const Scene scene = WithPaintedRectangles(Box(), {kWindow});
  std::map<std::string, double> areas = AreasOf(scene);
  EXPECT_NEAR(areas["window"], 3, 1e-9);
  EXPECT_NEAR(areas["wall 1"], 6 * 2.8 - 3, 1e-9);
  EXPECT_NEAR(areas["wall 3"], 6 * 2.8, 1e-9);
  EXPECT_NEAR(scene.VolumeM3(), 6 * 4 * 2.8, 1e-9);
  for (const Facet& facet : scene.facets) {
    if (scene.materials[static_cast<size_t>(facet.material)] != "window") continue;
    EXPECT_LT((facet.PointAt(0.5, 0.5) - Eigen::Vector3d(3, 0, 1.75)).norm(), 1e-9);
    EXPECT_LT((facet.Normal() - Eigen::Vector3d::UnitY()).norm(), 1e-9);
  }
}

TEST(PaintedRectangles, SeveralShareAWallAndReachItsEdge) {
  const PaintedRectangle door{"door", {1.2, 0, 0.002}, {-0.9, 0, 0}, {0, 0, 2.05}};
  const Scene scene = WithPaintedRectangles(Box(), {kWindow, door});
  std::map<std::string, double> areas = AreasOf(scene);
  EXPECT_NEAR(areas["window"], 3, 1e-9);
  EXPECT_NEAR(areas["door"], 0.9 * 2.052, 1e-9);  // a strip of 2 mm is not cut off
  EXPECT_NEAR(areas["wall 1"] + areas["door"], 6 * 2.8 - 3, 1e-9);
}

TEST(PaintedRectangles, WhatLiesInNoWallChangesNothing) {
  PaintedRectangle before = kWindow, turned = kWindow, behind = kWindow, aside = kWindow;
  before.corner.y() = 0.1;
  turned.edge_u = {-2, 0, 0.5};
  turned.edge_v = {0.4, 0, 1.6};
  behind.edge_u = -behind.edge_u;  // it faces out of the room
  aside.corner.x() = -1;
  for (const PaintedRectangle& none : {before, turned, behind, aside}) {
    const Scene scene = WithPaintedRectangles(Box(), {none});
    EXPECT_EQ(scene.facets.size(), Box().facets.size());
    EXPECT_EQ(scene.materials, Box().materials);
  }
}

}  // namespace
}  // namespace luxfit
