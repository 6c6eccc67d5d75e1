#include "forward/room/in_room.h"

#include <gtest/gtest.h>

#include "forward/room/scene.h"

namespace luxfit {
namespace {

void AddRectangle(const std::vector<Eigen::Vector3d>& corners, Scene& scene) {
  for (const Facet& facet : FacetsFromPolygon(corners, 0)) scene.facets.push_back(facet);
}

// 4 m x 3 m x 2.5 m seen from inside, with a table top of a single sheet at 0.75 m that faces up.
Scene RoomWithTable() {
  Scene scene;
  scene.materials = {"wall"};
  AddRectangle({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}}, scene);
  AddRectangle({{0, 0, 2.5}, {0, 3, 2.5}, {4, 3, 2.5}, {4, 0, 2.5}}, scene);
  AddRectangle({{0, 0, 0}, {0, 0, 2.5}, {4, 0, 2.5}, {4, 0, 0}}, scene);
  AddRectangle({{0, 3, 0}, {4, 3, 0}, {4, 3, 2.5}, {0, 3, 2.5}}, scene);
  AddRectangle({{0, 0, 0}, {0, 3, 0}, {0, 3, 2.5}, {0, 0, 2.5}}, scene);
  AddRectangle({{4, 0, 0}, {4, 0, 2.5}, {4, 3, 2.5}, {4, 3, 0}}, scene);
  AddRectangle({{1, 1, 0.75}, {2.6, 1, 0.75}, {2.6, 1.8, 0.75}, {1, 1.8, 0.75}}, scene);
  return scene;
}

TEST(IsInRoom, TellsTheOpenFromWhatNoMeterCanBeIn) {
  const RayScene rays(RoomWithTable());
  EXPECT_TRUE(IsInRoom(rays, {2, 1.5, 1}));
  EXPECT_TRUE(IsInRoom(rays, {0.002, 0.002, 0.002})) << "in a corner";
  EXPECT_TRUE(IsInRoom(rays, {1.8, 1.4, 0.751})) << "on the table";
  EXPECT_TRUE(IsInRoom(rays, {1.8, 1.4, 0.3})) << "under the table, where things lie";
  EXPECT_FALSE(IsInRoom(rays, {1.8, 1.4, 0.749})) << "on the back of its top";
  EXPECT_FALSE(IsInRoom(rays, {2, 1.5, -0.01})) << "under the floor";
  EXPECT_FALSE(IsInRoom(rays, {2, 1.5, 2.51})) << "above the ceiling";
  EXPECT_FALSE(IsInRoom(rays, {100, 0, 1}));
}

// A table top that is hit from above, and from below.
TEST(InFrontOf, IsOnTheSideFromWhichTheRayCame) {
  const Scene scene = RoomWithTable();
  const RayScene rays(scene);
  for (const double from_z : {2.0, 0.1}) {
    const Eigen::Vector3d from(1.8, 1.4, from_z);
    const RayHit hit = rays.Trace(from, {0, 0, from_z > 0.75 ? -1.0 : 1.0});
    ASSERT_GE(hit.facet, 0);
    const double side = from_z > 0.75 ? 1 : -1;
    EXPECT_TRUE(InFrontOf(scene, hit, {1.5, 1.2, 0.75 - 0.03 * side}, 0.01)
                    .isApprox(Eigen::Vector3d(1.5, 1.2, 0.75 + 0.01 * side)));
  }
}

TEST(IsInRoom, NothingIsInAnEmptyScene) { EXPECT_FALSE(IsInRoom(RayScene(Scene{}), {0, 0, 0})); }

}  // namespace
}  // namespace luxfit
