#include "forward/mesh/ray_shares.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

TEST(RayShares, AClosedRoomLosesNone) {
  Scene room = support::ClosedRoom({6, 4, 2.8});
  support::AddBox(room, {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(2, 2, 1)}, support::Facing::kOutward,
                  {"box"});
  // A sheet 1 mm in front of a wall has open edges, and loses no light.
  support::AddParallelogram(room, {0.001, 1, 0}, {0, 1, 0}, {0, 0, 2}, "door");
  const RayShares shares = EstimateRayShares(room);
  EXPECT_EQ(shares.escaped, 0);
  EXPECT_LT(shares.back, 0.05);
}

TEST(RayShares, ACubeWithoutCeilingLosesWhatItsFaceWouldTake) {
  Scene room = support::ClosedRoom({2, 2, 2});
  room.facets.pop_back();
  // Every face of a cube sends a fifth to each other one: 0.19982 to the face opposite.
  EXPECT_NEAR(EstimateRayShares(room).escaped, 0.2, 0.02);  // four points a face
}

TEST(RayShares, BacksAreMet) {
  Scene room = support::ClosedRoom({2, 2, 2});
  std::swap(room.facets[5].edge_u, room.facets[5].edge_v);
  const RayShares shares = EstimateRayShares(room);
  EXPECT_NEAR(shares.back, 0.2, 0.02);  // four points a face
  EXPECT_EQ(shares.escaped, 0) << "the turned face's own rays lie outside";
}

TEST(RayShares, AnEmptySceneIsNoError) { EXPECT_EQ(EstimateRayShares({}).back, 0); }

}  // namespace
}  // namespace luxfit
