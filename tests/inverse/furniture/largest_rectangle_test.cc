#include "inverse/furniture/internal/faces/largest_rectangle.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

int SumOf(const VoteGrid& votes, int row, int column, int rows, int columns) {
  return votes.block(row, column, rows, columns).cast<int>().sum();
}

TEST(LargestRectangle, OneWithoutPositiveVotesIsNone) {
  EXPECT_EQ(FindLargestRectangle(VoteGrid::Constant(4, 5, -1)).sum, 0);
  EXPECT_EQ(FindLargestRectangle(VoteGrid::Zero(4, 5)).sum, 0);
  EXPECT_EQ(FindLargestRectangle(VoteGrid(0, 0)).sum, 0);
}

TEST(LargestRectangle, ItReachesOverASmallHole) {
  VoteGrid votes = VoteGrid::Constant(9, 12, -1);
  votes.block(2, 3, 5, 6).setConstant(1);
  votes(4, 5) = -1;
  const VoteRectangle r = FindLargestRectangle(votes);
  EXPECT_EQ(r.row, 2);
  EXPECT_EQ(r.column, 3);
  EXPECT_EQ(r.rows, 5);
  EXPECT_EQ(r.columns, 6);
  EXPECT_EQ(r.sum, 28);
}

TEST(LargestRectangle, NoOtherRectangleHasALargerSum) {
  std::mt19937_64 rng = support::TestRng();
  for (int trial = 0; trial < 20; ++trial) {
    VoteGrid votes(7, 8);
    for (signed char& vote : votes.reshaped())
      vote = static_cast<signed char>(static_cast<int>(rng() % 3) - 1);
    int most = 0;
    for (int row = 0; row < 7; ++row)
      for (int column = 0; column < 8; ++column)
        for (int rows = 1; row + rows <= 7; ++rows)
          for (int columns = 1; column + columns <= 8; ++columns)
            most = std::max(most, SumOf(votes, row, column, rows, columns));
    const VoteRectangle r = FindLargestRectangle(votes);
    EXPECT_EQ(r.sum, most);
    EXPECT_EQ(SumOf(votes, r.row, r.column, r.rows, r.columns), most);
  }
}

}  // namespace
}  // namespace luxfit
