#include "forward/changes/plane_moves.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "forward/mesh/mesh_check.h"
#include "forward/mesh/outline.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

Scene Room() { return support::ClosedRoom({4, 3, 2.5}, {"w", "e", "s", "n", "floor", "ceiling"}); }

// Returns the bounds of what has a material.
Eigen::AlignedBox3d BoundsOf(const Scene& scene, const std::string& material) {
  Eigen::AlignedBox3d bounds;
  for (const Facet& facet : scene.facets)
    if (scene.materials[static_cast<size_t>(facet.material)] == material)
      for (const double u : {0.0, 1.0})
        for (const double v : {0.0, 1.0})
          if (facet.kind == FacetKind::kParallelogram || u + v < 2) bounds.extend(facet.PointAt(u, v));
  return bounds;
}

TEST(PlaneMoves, TheRoomStaysClosed) {
  const Scene moved = WithPlanesMoved(Room(), {{{-1, 0, 0}, -4, -0.05}});
  EXPECT_NEAR(moved.VolumeM3(), 4.05 * 3 * 2.5, 1e-9);
  EXPECT_EQ(moved.facets.size(), 6u);
  EXPECT_TRUE(CheckMesh(moved).empty());
  EXPECT_NEAR(BoundsOf(moved, "e").min().x(), 4.05, 1e-12);
  EXPECT_NEAR(BoundsOf(moved, "floor").max().x(), 4.05, 1e-12);
}

TEST(PlaneMoves, TwoThatMeetMoveInEitherOrder) {
  const PlaneMove east{{-1, 0, 0}, -4, 0.1}, ceiling{{0, 0, -1}, -2.5, -0.2};
  for (const std::vector<PlaneMove>& moves : {std::vector<PlaneMove>{east, ceiling}, {ceiling, east}}) {
    const Scene moved = WithPlanesMoved(Room(), moves);
    EXPECT_NEAR(moved.VolumeM3(), 3.9 * 3 * 2.7, 1e-9);
    EXPECT_TRUE(CheckMesh(moved).empty());
  }
}

// A wall that leans against the next one at 60 degrees: its corners slide along the others, whose planes stay.
TEST(PlaneMoves, CornersSlideAlongObliqueWalls) {
  RoomOutline outline;
  outline.corners_m = {{0, 0}, {5, 0}, {3, 3}, {0, 3}};
  outline.heights_m = {2.5, 2.5, 2.5, 2.5};
  const Scene room = SceneFrom(outline);
  const Scene moved = WithPlanesMoved(room, {{{0, -1, 0}, -3, -0.3}});
  // The slanted wall runs on to y = 3.3, at x = 5 - 2/3 3.3 = 2.8.
  EXPECT_NEAR(moved.Bounds().max().y(), 3.3, 1e-9);
  EXPECT_NEAR(moved.VolumeM3(), 2.5 * 3.3 * (5 + 2.8) / 2, 1e-9);
  EXPECT_TRUE(CheckMesh(moved).empty());
}

// A door goes along; a cupboard's back does, its front stays.
TEST(PlaneMoves, FlatPiecesGoAlongAndDeepOnesStretch) {
  Scene scene = Room();
  support::AddBox(scene, {Eigen::Vector3d(3.97, 1, 0), Eigen::Vector3d(4, 1.9, 2)}, support::Facing::kOutward,
                  {"door"});
  support::AddBox(scene, {Eigen::Vector3d(3.5, 0.1, 0), Eigen::Vector3d(4, 0.9, 2)},
                  support::Facing::kOutward, {"cupboard"});
  const Scene moved = WithPlanesMoved(scene, {{{-1, 0, 0}, -4, 0.05}});
  EXPECT_NEAR(BoundsOf(moved, "door").min().x(), 3.92, 1e-12);
  EXPECT_NEAR(BoundsOf(moved, "door").max().x(), 3.95, 1e-12);
  EXPECT_NEAR(BoundsOf(moved, "cupboard").min().x(), 3.5, 1e-12);
  EXPECT_NEAR(BoundsOf(moved, "cupboard").max().x(), 3.95, 1e-12);
}

TEST(PlaneMoves, ASurfaceOnPlanesIsRefused) {
  Scene scene = Room();
  scene.surface.push_back({{Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)}, 0});
  EXPECT_THROW(WithPlanesMoved(scene, {{{-1, 0, 0}, -4, 0.05}}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
