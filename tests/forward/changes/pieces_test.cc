#include "forward/changes/pieces.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using support::AddBox;
using support::AddParallelogram;

Scene EmptyRoom() {
  return support::ClosedRoom({4, 3, 2.5}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
}

// A room with a table of two boards that touch, and a shelf by itself.
Scene Furnished() {
  Scene scene = EmptyRoom();
  AddParallelogram(scene, {1, 1, 0.8}, {1, 0, 0}, {0, 1, 0}, "table");
  AddParallelogram(scene, {1, 1, 0.1}, {1, 0, 0}, {0, 0, 0.7}, "table");
  AddParallelogram(scene, {3, 2, 1.5}, {0.5, 0, 0}, {0, 0.5, 0}, "shelf");
  return scene;
}

TEST(Pieces, FurnitureIsWhatTheRoomIsNot) {
  const std::vector<std::vector<int>> pieces = LoosePieces(Furnished());
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0], (std::vector<int>{6, 7}));
  EXPECT_EQ(pieces[1], (std::vector<int>{8}));
}

// A cupboard in the corner has its back and its bottom on the room's bounding box, and shares a corner with the room.
TEST(Pieces, ACupboardKeepsItsBackAndItsBottom) {
  Scene scene = EmptyRoom();
  AddBox(scene, {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.5, 1, 2)}, support::Facing::kOutward,
         {"cupboard"});
  const std::vector<std::vector<int>> pieces = LoosePieces(scene);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].size(), 6u);
}

TEST(Pieces, AWallThatIsWoundTheWrongWayIsNone) {
  Scene scene = EmptyRoom();
  std::swap(scene.facets[0].edge_u, scene.facets[0].edge_v);
  EXPECT_TRUE(LoosePieces(scene).empty());
}

TEST(Pieces, WhatIsLeftOutTakesItsMaterialAlong) {
  const Scene bare = WithoutFacets(Furnished(), {6, 7});
  EXPECT_EQ(bare.facets.size(), 7u);
  EXPECT_EQ(bare.materials, (std::vector<std::string>{"wall", "floor", "ceiling", "shelf"}));
  EXPECT_EQ(bare.materials[static_cast<size_t>(bare.facets[6].material)], "shelf");
}

TEST(Pieces, OneMovesAndOneIsLeftOut) {
  const Scene scene = Furnished();
  const std::vector<std::vector<int>> pieces = LoosePieces(scene);
  const Eigen::Vector3d by(0.5, 0, 0);
  const Scene changed =
      WithPiecesMoved(scene, {{BoundsOf(scene, pieces[0]), by}, {BoundsOf(scene, pieces[1]), std::nullopt}});
  ASSERT_EQ(changed.facets.size(), 8u);
  for (size_t f = 0; f < 8; ++f)
    EXPECT_EQ(changed.facets[f].origin, scene.facets[f].origin + (f < 6 ? Eigen::Vector3d(0, 0, 0) : by));
}

TEST(Pieces, APieceOfOtherBoundsStays) {
  const Scene scene = Furnished();
  Eigen::AlignedBox3d bounds = BoundsOf(scene, LoosePieces(scene)[1]);
  bounds.max().x() += 0.01;
  EXPECT_EQ(WithPiecesMoved(scene, {{bounds, std::nullopt}}).facets.size(), scene.facets.size());
}

}  // namespace
}  // namespace luxfit
