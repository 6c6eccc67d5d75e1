// Maps an L-shaped room, whose volume tells whether fronts stayed fronts.
#include "forward/changes/frame_mistakes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "forward/mesh/outline.h"

namespace luxfit {
namespace {

Scene LShaped() {
  RoomOutline outline;
  outline.corners_m = {{0, 0}, {5, 0}, {5, 2}, {3, 2}, {3, 4}, {0, 4}};
  outline.heights_m = {2.5};
  return SceneFrom(outline);
}

FrameMistake Named(const std::string& as_if) {
  for (const FrameMistake& mistake : FrameMistakesOf(LShaped()))
    if (mistake.as_if == as_if) return mistake;
  ADD_FAILURE() << "no mistake is called " << as_if;
  return {};
}

TEST(FrameMistakes, FrontsStayFrontsAndTheRoomKeepsItsVolume) {
  const Scene room = LShaped();
  const double volume_m3 = 2.5 * (5 * 2 + 3 * 2);
  ASSERT_NEAR(room.VolumeM3(), volume_m3, 1e-9);
  const std::vector<FrameMistake> mistakes = FrameMistakesOf(room);
  EXPECT_EQ(mistakes.size(), 14u);
  for (const FrameMistake& mistake : mistakes)
    EXPECT_NEAR(WithMeshMapped(room, mistake.right_from_given).VolumeM3(), volume_m3, 1e-9) << mistake.as_if;
}

TEST(FrameMistakes, AMirrorOfTheMiddleKeepsTheBoundsAndUndoesItself) {
  const Scene room = LShaped();
  const Eigen::Affine3d map = Named("mirrored in x").right_from_given;
  const Scene mirrored = WithMeshMapped(room, map);
  EXPECT_TRUE(mirrored.Bounds().isApprox(room.Bounds(), 1e-9));
  EXPECT_NEAR(DistanceToSurface(mirrored, {2, 3, 1}), 0, 1e-9);  // x = 3 of the L's inner corner
  EXPECT_TRUE((map * map).isApprox(Eigen::Affine3d::Identity(), 1e-9));
}

TEST(FrameMistakes, FacetsThatAreNotListedStay) {
  const Scene room = LShaped();
  const Scene some = WithFacetsMapped(room, {0}, Named("mirrored in x").right_from_given);
  for (size_t f = 1; f < room.facets.size(); ++f) EXPECT_EQ(some.facets[f].origin, room.facets[f].origin);
}

}  // namespace
}  // namespace luxfit
