#include "calib/targets/board.h"

#include <gmock/gmock.h>

#include <limits>
#include <stdexcept>

#include "tests/support/calib/sample_boards.h"

namespace luxfit {
namespace {

using ::testing::HasSubstr;

Board KalibrGrid() { return support::AprilGrid(6, 5, 0.1); }
Board Chessboard() { return support::Chessboard(9, 6, 0.025); }
Board Charuco() { return support::Charuco(8, 6, 0.03, 0.022); }

TEST(BoardTest, AprilGridCornersAreThoseOfTheBlackSquares) {
  const std::vector<Eigen::Vector3d> corners = BoardCorners(KalibrGrid());
  ASSERT_EQ(corners.size(), 120u);
  EXPECT_TRUE((BoardCornerCounts(KalibrGrid()) == Eigen::Array2i(12, 10)).all());
  EXPECT_TRUE(corners[0].isZero());
  EXPECT_TRUE(corners[1].isApprox(Eigen::Vector3d(0.1, 0, 0)));   // the first tag's right side
  EXPECT_TRUE(corners[2].isApprox(Eigen::Vector3d(0.13, 0, 0)));  // a gap of 0.3 tags
  EXPECT_TRUE(corners[12].isApprox(Eigen::Vector3d(0, 0.1, 0)));  // row by row
  EXPECT_TRUE(corners[119].isApprox(Eigen::Vector3d(0.75, 0.62, 0)));
}

TEST(BoardTest, ChessboardsCountInnerCornersAndCharucoSquares) {
  EXPECT_EQ(BoardCorners(Chessboard()).size(), 54u);
  EXPECT_TRUE(BoardCorners(Chessboard())[10].isApprox(Eigen::Vector3d(0.025, 0.025, 0)));
  EXPECT_EQ(BoardCorners(Charuco()).size(), 35u);
  EXPECT_TRUE(BoardCorners(Charuco())[8].isApprox(Eigen::Vector3d(0.03, 0.03, 0)));
}

std::string ErrorOf(const Board& board) {
  try {
    BoardCorners(board);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(BoardTest, WhatIsMissingOrOutOfRangeIsNamed) {
  Board board = KalibrGrid();
  board.tag_size_m = 0;
  EXPECT_THAT(ErrorOf(board), HasSubstr("tag_size_m: expected the side of a tag's black square, m, got 0"));
  board = KalibrGrid();
  board.spacing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(ErrorOf(board), HasSubstr("spacing: "));
  board = KalibrGrid();
  board.rows = -1;
  EXPECT_THAT(ErrorOf(board), HasSubstr("rows: expected at least 1 tag, got -1"));
  board = KalibrGrid();
  board.first_id = 570;
  EXPECT_THAT(ErrorOf(board), HasSubstr("first_id: expected 0 to 557"));
  board.first_id = std::numeric_limits<int>::max();
  EXPECT_THAT(ErrorOf(board), HasSubstr("first_id: expected 0 to 557"));
  board = KalibrGrid();
  board.family = "tag36h12";
  EXPECT_THAT(ErrorOf(board), HasSubstr("tag36h12"));
  board = Chessboard();
  board.columns = 2;
  EXPECT_THAT(ErrorOf(board), HasSubstr("columns: expected at least 3 inner corners, got 2"));
  board = Chessboard();
  board.square_size_m = -0.025;
  EXPECT_THAT(ErrorOf(board), HasSubstr("square_size_m: expected the side of a square, m, got -0.025"));
  board = Charuco();
  board.tag_size_m = 0.03;
  EXPECT_THAT(ErrorOf(board), HasSubstr("tag_size_m: expected a marker smaller than its square, got 0.03"));
  board = Charuco();
  board.columns = 30;
  EXPECT_THAT(ErrorOf(board), HasSubstr("the board has 90 tags, DICT_4X4_50 50"));
  board = Charuco();
  board.dictionary = "DICT_4X4";
  EXPECT_THAT(ErrorOf(board), HasSubstr("expected one of DICT_4X4_50"));
}

}  // namespace
}  // namespace luxfit
