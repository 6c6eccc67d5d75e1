#include "inverse/select/internal/spatial_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <utility>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using Places = std::vector<Eigen::Vector3d>;

// `columns` x `rows` places a metre apart, row by row along y.
Places Grid(int columns, int rows) {
  Places places;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) places.emplace_back(i, j, 0.7);
  }
  return places;
}

Places RandomPlaces(int count, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> metres(0, 5);
  Places places;
  for (int i = 0; i < count; ++i) places.emplace_back(metres(rng), metres(rng), metres(rng));
  return places;
}

// The number of places in each block; every number from 0 to the last is one.
std::vector<int> SizesOf(const std::vector<int>& block) {
  std::vector<int> sizes;
  for (const int b : block) {
    if (b < 0) ADD_FAILURE() << "block " << b;
    if (b >= static_cast<int>(sizes.size())) sizes.resize(static_cast<size_t>(b) + 1);
    ++sizes[static_cast<size_t>(b)];
  }
  EXPECT_EQ(std::count(sizes.begin(), sizes.end(), 0), 0);
  return sizes;
}

int CountOf(const std::vector<int>& block) { return static_cast<int>(SizesOf(block).size()); }

TEST(SpatialBlocks, AGridIsCutIntoEqualRectangles) {
  const Places places = Grid(16, 8);
  const std::vector<int> block = SpatialBlocks(places, 8);
  EXPECT_EQ(SizesOf(block), std::vector<int>(8, 16));
  for (int b = 0; b < 8; ++b) {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = -low;
    for (size_t i = 0; i < places.size(); ++i) {
      if (block[i] != b) continue;
      low = low.cwiseMin(places[i]), high = high.cwiseMax(places[i]);
    }
    EXPECT_EQ(high - low, Eigen::Vector3d(3, 3, 0)) << b;  // 4 x 4 places
  }
}

// Numbers that are no powers of two: no block gets more than its share and a row.
TEST(SpatialBlocks, BlocksHoldNearlyEqualShares) {
  for (const int side : {10, 12, 20, 32}) {
    const std::vector<int> sizes = SizesOf(SpatialBlocks(Grid(side, side), 40));
    ASSERT_EQ(sizes.size(), 40u) << side;
    const double share = side * side / 40.0;
    const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
    EXPECT_GE(*least, std::floor(share)) << side;
    EXPECT_LE(*most, std::ceil(share)) << side;
  }
}

TEST(SpatialBlocks, EqualPlacesShareABlock) {
  std::mt19937_64 rng = support::TestRng();
  Places places = RandomPlaces(60, rng);
  // Some places were read in one state, some in five.
  const Places once = places;
  for (size_t i = 0; i < once.size(); i += 3) places.insert(places.end(), 4, once[i]);
  const std::vector<int> block = SpatialBlocks(places, 12);
  EXPECT_EQ(CountOf(block), 12);
  for (size_t i = 0, next = once.size(); i < once.size(); i += 3) {
    for (int copy = 0; copy < 4; ++copy, ++next) EXPECT_EQ(block[next], block[i]);
  }
}

TEST(SpatialBlocks, AlongALineConsecutiveBlocksAdjoin) {
  const std::vector<int> block = SpatialBlocks(Grid(50, 1), 10);
  EXPECT_EQ(CountOf(block), 10);
  EXPECT_TRUE(std::is_sorted(block.begin(), block.end()));
}

// The purpose of the numbering: of the blocks that adjoin each other, hardly any two are left out together,
// and no part of the plane loses all of its blocks to one fold.
TEST(SpatialBlocks, FoldsAreSpreadOverThePlane) {
  constexpr int kSide = 20, kFolds = 5;
  const std::vector<int> block = SpatialBlocks(Grid(kSide, kSide), 8 * kFolds);
  const auto at = [&](int i, int j) { return block[static_cast<size_t>(i * kSide + j)]; };
  std::set<std::pair<int, int>> adjoining;
  for (int i = 0; i + 1 < kSide; ++i) {
    for (int j = 0; j + 1 < kSide; ++j) {
      for (const int other : {at(i + 1, j), at(i, j + 1)}) {
        if (other != at(i, j)) adjoining.insert(std::minmax(at(i, j), other));
      }
    }
  }
  const auto in_one_fold = std::count_if(adjoining.begin(), adjoining.end(), [](const auto& pair) {
    return pair.first % kFolds == pair.second % kFolds;
  });
  EXPECT_GT(adjoining.size(), 60u);
  EXPECT_LE(static_cast<double>(in_one_fold), 0.1 * static_cast<double>(adjoining.size()));  // random: 0.2
  for (int i = 0; i < kSide; i += 5) {
    for (int j = 0; j < kSide; j += 10) {
      std::set<int> folds;
      for (int k = 0; k < 50; ++k) folds.insert(at(i + k / 10, j + k % 10) % kFolds);
      EXPECT_EQ(folds.size(), static_cast<size_t>(kFolds)) << i << ", " << j;
    }
  }
}

TEST(SpatialBlocks, EveryDistinctPlaceIsABlockWhereThereAreFewer) {
  std::mt19937_64 rng = support::TestRng();
  const auto expect_one_each = [](const Places& distinct, int blocks) {
    Places places = distinct;
    places.insert(places.end(), distinct.begin(), distinct.begin() + static_cast<int>(distinct.size()) / 2);
    EXPECT_EQ(CountOf(SpatialBlocks(places, blocks)), static_cast<int>(distinct.size())) << blocks;
  };
  for (const int count : {1, 2, 5, 7, 10, 50}) {
    for (const int more : {0, 1, 37}) {
      expect_one_each(Grid(count, 1), count + more);
      expect_one_each(RandomPlaces(count, rng), count + more);
    }
  }
  expect_one_each(Grid(5, 5), 25);
}

TEST(SpatialBlocks, NoPlacesHaveNoBlocks) { EXPECT_TRUE(SpatialBlocks({}, 40).empty()); }

TEST(SpatialBlocks, OneBlockHoldsAll) {
  EXPECT_EQ(SpatialBlocks(Grid(3, 2), 1), std::vector<int>(6, 0));
  EXPECT_EQ(SpatialBlocks(Places(4, {1, 2, 3}), 40), std::vector<int>(4, 0));
}

TEST(SpatialBlocks, TheOrderOfThePlacesDoesNotMatter) {
  std::mt19937_64 rng = support::TestRng();
  for (Places places : {Grid(9, 7), RandomPlaces(100, rng)}) {
    places.insert(places.end(), places.begin(), places.begin() + 10);
    const std::vector<int> block = SpatialBlocks(places, 11);
    std::vector<size_t> order(places.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::shuffle(order.begin(), order.end(), rng);
    Places shuffled;
    for (const size_t i : order) shuffled.push_back(places[i]);
    const std::vector<int> again = SpatialBlocks(shuffled, 11);
    for (size_t i = 0; i < order.size(); ++i) EXPECT_EQ(again[i], block[order[i]]);
  }
}

}  // namespace
}  // namespace luxfit
