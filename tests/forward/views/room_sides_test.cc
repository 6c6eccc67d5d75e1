#include "forward/views/room_sides.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

Room RoomOf(const Scene& scene) {
  RoomOptions options;
  options.patches = {1.0, 1.0};
  return MakeRoom(scene, options);
}

TEST(RoomSides, OfABoxAreFourWallsAndTheCeiling) {
  const std::vector<RoomSide> sides = SidesOf(RoomOf(support::ClosedRoom({6, 4, 2.8})));
  ASSERT_EQ(sides.size(), 5U);
  double walls_m2 = 0;
  const Eigen::Vector3d middle(3, 2, 1.4);
  for (const RoomSide& side : sides) {
    const Eigen::Vector3d normal = side.plane.edge_u.cross(side.plane.edge_v).normalized();
    EXPECT_GT(normal.dot(middle - side.plane.origin), 0);  // its meters face into the room
    EXPECT_NEAR(side.plane.edge_u.cross(side.plane.edge_v).norm(), side.area_m2, 1e-6);
    if (!side.is_ceiling) walls_m2 += side.area_m2;
  }
  EXPECT_NEAR(walls_m2, 2 * (6 + 4) * 2.8, 1e-6);
  EXPECT_TRUE(sides.back().is_ceiling);
  EXPECT_NEAR(sides.back().area_m2, 24, 1e-6);
  EXPECT_NEAR(sides.back().plane.origin.z(), 2.79, 1e-6);
}

// A cabinet of 1 m x 0.5 m x 2 m with its back on the wall y = 0: its sides are none of the room, and what it hides of
// the wall does not count.
TEST(RoomSides, FurnitureIsNoSideAndHidesTheWall) {
  Scene scene = support::ClosedRoom({6, 4, 3});
  support::AddBox(scene, Eigen::AlignedBox3d(Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(3, 0.5, 2)),
                  support::Facing::kOutward, {"cabinet"});
  const Room room = RoomOf(scene);
  const std::vector<RoomSide> sides = SidesOf(room);
  ASSERT_EQ(sides.size(), 5U);
  const auto wall = std::find_if(sides.begin(), sides.end(), [](const RoomSide& side) {
    return side.plane.edge_u.cross(side.plane.edge_v).normalized().y() > 0.99;
  });
  ASSERT_NE(wall, sides.end());
  const PlaneGrid grid = GridOf(wall->plane, 6, 3);  // cells of 1 m
  const std::vector<GridPointKind> kinds = ClassifySidePoints(room, *wall, grid);
  for (size_t i = 0; i < kinds.size(); ++i) {
    const Eigen::Vector3d point = grid.points.col(static_cast<Eigen::Index>(i));
    const bool is_hidden = point.x() > 2 && point.x() < 3 && point.z() < 2;
    EXPECT_EQ(kinds[i], is_hidden ? GridPointKind::kInSolid : GridPointKind::kCounts) << point.transpose();
  }
}

// The gable of a room whose ceiling rises from 2 m to 4 m: points beyond its slope do not count.
TEST(RoomSides, PointsBeyondAGableAreOutside) {
  Scene scene;
  support::AddParallelogram(scene, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, "floor");
  support::AddParallelogram(scene, {0, 0, 0}, {0, 0, 2}, {2, 0, 0}, "gable");
  support::AddTriangle(scene, {0, 0, 2}, {2, 0, 2}, {2, 0, 0}, "gable");
  const Room room = RoomOf(scene);
  const std::vector<RoomSide> sides = SidesOf(room);
  ASSERT_EQ(sides.size(), 1U);
  EXPECT_NEAR(sides[0].area_m2, 4 + 2, 1e-9);
  const PlaneGrid grid = GridOf(sides[0].plane, 20, 40);
  const std::vector<GridPointKind> kinds = ClassifySidePoints(room, sides[0], grid);
  const auto counted = std::count(kinds.begin(), kinds.end(), GridPointKind::kCounts);
  EXPECT_NEAR(static_cast<double>(counted) / 800, 6.0 / 8,
              0.02);  // of the rectangle's area; half a cell along the slope
}

}  // namespace
}  // namespace luxfit
