#include "forward/views/illuminance_plane.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

Room RoomOfScene(const Scene& scene) {
  RoomOptions options;
  options.patches = {1.0, 1.0};
  return MakeRoom(scene, options);
}

std::ptrdiff_t Count(const std::vector<GridPointKind>& kinds, GridPointKind kind) {
  return std::count(kinds.begin(), kinds.end(), kind);
}

TEST(WorkPlane, OfARoomIsItsFloorLessTheBand) {
  const auto plane = FloorPlane(support::ClosedRoom({6, 4, 2.8}), 0.75);
  ASSERT_TRUE(plane);
  EXPECT_TRUE(plane->origin.isApprox(Eigen::Vector3d(0.5, 0.5, 0.75), 1e-9)) << plane->origin.transpose();
  EXPECT_NEAR(plane->edge_u.norm(), 5, 1e-9);
  EXPECT_NEAR(plane->edge_v.norm(), 3, 1e-9);
  EXPECT_GT(plane->edge_u.cross(plane->edge_v).z(), 0);
}

TEST(WorkPlane, TheBandOfASmallRoomIs15Percent) {
  const auto plane = FloorPlane(support::ClosedRoom({3, 2, 2.5}), 0);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->edge_v.norm(), 2 - 2 * 0.3, 1e-9);
  EXPECT_FALSE(FloorPlane(support::ClosedRoom({3, 2, 2.5}), 0, 1.0));
  EXPECT_FALSE(FloorPlane(Scene{}, 0.75));
}

// An L of 4 m x 4 m without its upper right quarter, and a cabinet on it.
TEST(WorkPlane, PointsOffTheFloorAndInSolidsDoNotCount) {
  Scene scene;
  scene.materials = {"wall"};
  const std::vector<Eigen::Vector2d> outline = {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};
  std::vector<Eigen::Vector3d> floor, ceiling;
  for (const Eigen::Vector2d& p : outline) floor.emplace_back(p.x(), p.y(), 0);
  for (auto p = outline.rbegin(); p != outline.rend(); ++p) ceiling.emplace_back(p->x(), p->y(), 2.5);
  for (const auto& polygon : {floor, ceiling}) {
    for (const Facet& facet : FacetsFromPolygon(polygon, 0)) scene.facets.push_back(facet);
  }
  for (size_t i = 0; i < floor.size(); ++i) {
    const Eigen::Vector3d a = floor[i], b = floor[(i + 1) % floor.size()], up(0, 0, 2.5);
    for (const Facet& facet : FacetsFromPolygon({b, a, a + up, b + up}, 0)) scene.facets.push_back(facet);
  }
  support::AddBox(scene, {Eigen::Vector3d(0, 3, 0), Eigen::Vector3d(1, 4, 2)}, support::Facing::kOutward,
                  {"wall"});
  const Room room = RoomOfScene(scene);
  auto plane = FloorPlane(scene, 0.75, 0);
  ASSERT_TRUE(plane);
  plane->spacing_m = 0.5;
  const PlaneGrid grid = GridOf(*plane);
  ASSERT_EQ(grid.points.cols(), 64);
  const std::vector<GridPointKind> kinds = ClassifyPoints(room, grid, {}, true);
  EXPECT_EQ(Count(kinds, GridPointKind::kOutside), 16);
  EXPECT_EQ(Count(kinds, GridPointKind::kInSolid), 4);
  const std::vector<GridPointKind> within =
      ClassifyPoints(room, grid, {{0, 0}, {2, 0}, {2, 2}, {0, 2}}, true);
  EXPECT_EQ(Count(within, GridPointKind::kCounts), 16);
}

// Turned by 30 degrees and cut into triangles: the rectangle turns with it, whatever the diagonals.
TEST(WorkPlane, LiesAlongATurnedRoom) {
  const Eigen::AngleAxisd turn(0.5236, Eigen::Vector3d::UnitZ());
  Scene scene;
  scene.materials = {"floor"};
  const std::vector<Eigen::Vector3d> corners = {
      turn * Eigen::Vector3d(0, 0, 0), turn * Eigen::Vector3d(5, 0, 0), turn * Eigen::Vector3d(5, 3, 0),
      turn * Eigen::Vector3d(0, 3, 0)};
  for (const auto& triangle : {std::vector<Eigen::Vector3d>{corners[0], corners[1], corners[2]},
                               std::vector<Eigen::Vector3d>{corners[0], corners[2], corners[3]}}) {
    for (const Facet& facet : FacetsFromPolygon(triangle, 0)) scene.facets.push_back(facet);
  }
  const auto plane = FloorPlane(scene, 0.75, 0);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->edge_u.norm(), 5, 1e-9);
  EXPECT_NEAR(plane->edge_v.norm(), 3, 1e-9);
  EXPECT_TRUE(plane->edge_u.normalized().isApprox(turn * Eigen::Vector3d::UnitX(), 1e-9));
}

TEST(WorkPlane, OverAnOutline) {
  const IlluminancePlane plane = PlaneOverOutline({{1, 1}, {3, 1}, {2, 4}}, 0.8);
  EXPECT_TRUE(plane.origin.isApprox(Eigen::Vector3d(1, 1, 0.8)));
  EXPECT_TRUE(plane.edge_v.isApprox(Eigen::Vector3d(0, 3, 0)));
  EXPECT_THROW(PlaneOverOutline({{1, 1}, {3, 1}}, 0.8), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
