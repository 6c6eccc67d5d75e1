#include "calib/targets/board_search.h"

#include <gtest/gtest.h>

#include "tests/support/calib/board_render.h"
#include "tests/support/calib/sample_boards.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

Board ChessboardOf(int columns, int rows) { return support::Chessboard(columns, rows, 0.03); }

Board Charuco(int columns, int rows, const std::string& dictionary) {
  Board board = support::Charuco(columns, rows, 0.03, 0.021);
  board.dictionary = dictionary;
  return board;
}

Board AprilGrid(int columns, int rows, const std::string& family) {
  Board board = support::AprilGrid(columns, rows, 0.03);
  board.family = family;
  return board;
}

// A photo of the whole board, tilted.
ImagePlane PhotoOf(const Board& board) {
  Camera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx_px = camera.fy_px = 600;
  camera.cx_px = 319.5;
  camera.cy_px = 239.5;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(0.3, Eigen::Vector3d(0.8, 0.6, 0)).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(0, 0, 0.6) - pose.linear() * BoardCorners(board).back() / 2;
  support::BoardRenderOptions options;
  options.samples_per_axis = 2;
  auto rng = support::TestRng();
  return 255 * support::BoardRenderer(camera).Render(pose, DrawBoard(board), rng, options);
}

void ExpectFound(const Board& shown, const Board& expected) {
  const auto found = SearchBoard(PhotoOf(shown), expected);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->type, shown.type);
  EXPECT_EQ(found->columns, shown.columns);
  EXPECT_EQ(found->rows, shown.rows);
  EXPECT_EQ(found->dictionary, shown.dictionary);
  EXPECT_EQ(found->family, shown.family);
}

TEST(BoardSearch, AChessboardOfOtherCountsIsFound) {
  ExpectFound(ChessboardOf(9, 6), ChessboardOf(8, 6));
  ExpectFound(ChessboardOf(7, 4), ChessboardOf(9, 6));
}

TEST(BoardSearch, AChessboardLiesAsTheExpectedOne) {
  const auto found = SearchBoard(PhotoOf(ChessboardOf(9, 6)), ChessboardOf(5, 8));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->columns, 6);
  EXPECT_EQ(found->rows, 9);
  EXPECT_EQ(found->square_size_m, 0.03) << "no photo tells sizes";
}

TEST(BoardSearch, ACharucoBoardOfOtherCountsOrMarkersIsFound) {
  const Board expected = Charuco(8, 6, "DICT_4X4_50");
  ExpectFound(Charuco(6, 8, "DICT_4X4_50"), expected);
  ExpectFound(Charuco(7, 5, "DICT_4X4_50"), expected);
  ExpectFound(Charuco(8, 6, "DICT_5X5_50"), expected);
  ExpectFound(Charuco(5, 7, "DICT_6X6_50"), expected);
}

TEST(BoardSearch, ADictionaryThatFitsStays) {
  const auto found = SearchBoard(PhotoOf(Charuco(7, 5, "DICT_5X5_50")), Charuco(8, 6, "DICT_5X5_100"));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->dictionary, "DICT_5X5_100") << "its first markers are those of DICT_5X5_50";
}

TEST(BoardSearch, AnAprilGridOfOtherCountsOrFamilyIsFound) {
  ExpectFound(AprilGrid(6, 4, "tag36h11"), AprilGrid(4, 6, "tag36h11"));
  ExpectFound(AprilGrid(5, 4, "tag25h9"), AprilGrid(6, 6, "tag36h11"));
}

TEST(BoardSearch, ABoardOfAnotherKindIsFound) {
  ExpectFound(Charuco(8, 6, "DICT_4X4_50"), ChessboardOf(7, 5));
  ExpectFound(AprilGrid(6, 4, "tag36h11"), Charuco(6, 4, "DICT_4X4_50"));
  ExpectFound(ChessboardOf(9, 6), Charuco(10, 7, "DICT_4X4_50"));
}

TEST(BoardSearch, AWallShowsNone) {
  EXPECT_FALSE(SearchBoard(ImagePlane::Constant(480, 640, 128), ChessboardOf(9, 6)));
  EXPECT_FALSE(SearchBoard(ImagePlane(), ChessboardOf(9, 6)));
}

TEST(BoardSearch, MostPhotosDecideAndPartsCountAsTheWhole) {
  const Board whole = Charuco(8, 6, "DICT_4X4_50"), part = Charuco(8, 4, "DICT_4X4_50");
  const auto shown = MostShown({ChessboardOf(9, 6), part, std::nullopt, whole, part, ChessboardOf(8, 6)});
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->photos, 3U);
  EXPECT_EQ(shown->board.rows, 6);
  EXPECT_EQ(shown->board.type, BoardType::kCharuco);
  EXPECT_FALSE(MostShown({std::nullopt}));
}

}  // namespace
}  // namespace luxfit
