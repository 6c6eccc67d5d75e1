// Moves walls of fixtures/office in its mesh, while the photos, which an independent renderer made, show them where they
// are. Limits are 1.5 times what was measured.
#include "inverse/furniture/moved_walls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "apps/session/tag_map.h"
#include "forward/mesh/mesh_file.h"
#include "forward/mesh/outline.h"
#include "inverse/furniture/internal/hull_planes.h"
#include "tests/support/office_truth.h"
#include "tests/support/office_views.h"

namespace luxfit {
namespace {

using support::OfficeViews;

Scene Office() { return ReadScene(support::kOfficeFolder + "room.obj"); }

std::vector<SurveyedTag> Survey() { return ReadTagMap(support::kOfficeFolder + "tags.json"); }

const PlaneMove kWest{{1, 0, 0}, 0, 0}, kEast{{-1, 0, 0}, -6, 0}, kSouth{{0, 1, 0}, 0, 0},
    kNorth{{0, -1, 0}, -4, 0}, kFloor{{0, 0, 1}, 0, 0}, kCeiling{{0, 0, -1}, -2.8, 0};

// Returns a plane of the office with a move: positive is into the room.
PlaneMove By(PlaneMove plane, double by_m) {
  plane.by_m = by_m;
  return plane;
}

std::vector<MovedWall> Find(const Scene& mesh, const std::vector<SurveyedTag>& survey = Survey()) {
  MovedWallsOptions options;
  options.survey = survey;
  std::vector<MovedWall> walls = FindMovedWalls(mesh, OfficeViews(), options);
  for (const MovedWall& wall : walls)
    std::printf("%s at %.2f moves by %+.4f +- %.4f m, %d views, %.1f m2, %d tags\n", wall.material.c_str(),
                wall.move.offset_m, wall.move.by_m, wall.sigma_m, wall.views, wall.area_m2, wall.tags);
  return walls;
}

TEST(MovedWalls, TheOfficesStandWhereTheMeshHasThem) { EXPECT_TRUE(Find(Office()).empty()); }

// Desks, cabinet and door are none: the room's surfaces lie behind them.
TEST(MovedWalls, TheHullIsWallsFloorAndCeiling) {
  const Scene office = Office();
  const std::vector<HullPlane> hull = FindHullPlanes(office, RayScene(office));
  EXPECT_EQ(hull.size(), 6u);
  for (const HullPlane& plane : hull) EXPECT_GT(plane.area_m2, 11);
  RoomOutline outline;
  outline.corners_m = {{0, 0}, {5, 0}, {5, 2}, {3, 2}, {3, 4}, {0, 4}};
  outline.heights_m = {2.5};
  const Scene l_shaped = SceneFrom(outline);
  EXPECT_EQ(FindHullPlanes(l_shaped, RayScene(l_shaped)).size(), 8u);
}

TEST(MovedWalls, EachIsPutBack) {
  for (const PlaneMove& plane : {kWest, kEast, kSouth, kNorth, kFloor, kCeiling}) {
    for (const double by_m : {-0.1, -0.05, -0.02, 0.02, 0.05, 0.1}) {
      const std::vector<MovedWall> found = Find(WithPlanesMoved(Office(), {By(plane, by_m)}));
      ASSERT_EQ(found.size(), 1u) << plane.normal.transpose() << ", " << by_m;
      const double off_m = found[0].move.by_m + by_m;
      EXPECT_LT((found[0].move.normal - plane.normal).norm(), 1e-9);
      EXPECT_NEAR(found[0].move.offset_m, plane.offset_m + by_m, 1e-9);
      EXPECT_LT(std::abs(off_m), 0.003);                   // 1.9 mm
      EXPECT_LT(std::abs(off_m), 1.5 * found[0].sigma_m);  // 0.7
    }
  }
}

// The ceiling carries no tag, the longer walls three each.
TEST(MovedWalls, TagsThatLieThereAreCounted) {
  const std::vector<MovedWall> found =
      Find(WithPlanesMoved(Office(), {By(kNorth, -0.05), By(kCeiling, 0.05)}));
  ASSERT_EQ(found.size(), 2u);
  for (const MovedWall& wall : found) EXPECT_EQ(wall.tags, wall.material == "ceiling" ? 0 : 3);
}

TEST(MovedWalls, TwoWallsOfACornerAreBothPutBack) {
  const Scene mesh = WithPlanesMoved(Office(), {By(kEast, -0.05), By(kNorth, 0.04)});
  const std::vector<MovedWall> found = Find(mesh);
  ASSERT_EQ(found.size(), 2u);
  for (const MovedWall& wall : found)
    EXPECT_NEAR(wall.move.by_m, wall.material == "wall_accent" ? 0.05 : -0.04, 0.003);
}

// Half a centimetre is nothing that the light would show.
TEST(MovedWalls, SmallErrorsStay) {
  EXPECT_TRUE(Find(WithPlanesMoved(Office(), {By(kNorth, 0.005)})).empty());
}

TEST(MovedWalls, ATagOnTheMeshHoldsItsWall) {
  std::vector<SurveyedTag> survey = Survey();
  for (SurveyedTag& tag : survey)
    if (tag.id == 7) tag.center_in_world.y() = 4.05;
  EXPECT_TRUE(Find(WithPlanesMoved(Office(), {By(kNorth, -0.05)}), survey).empty());
}

TEST(MovedWalls, TwoViewsFindNothing) {
  const std::vector<SignatureView> two(OfficeViews().begin(), OfficeViews().begin() + 2);
  EXPECT_TRUE(FindMovedWalls(WithPlanesMoved(Office(), {By(kNorth, -0.05)}), two).empty());
}

}  // namespace
}  // namespace luxfit
