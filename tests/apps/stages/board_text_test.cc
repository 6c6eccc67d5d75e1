#include "apps/stages/calibrate/board_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace luxfit {
namespace {

using testing::HasSubstr;

std::string Refusal(const std::string& text) {
  try {
    BoardFromArgument(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none: " + text;
}

TEST(BoardText, EveryKindIsReadWithAndWithoutItsLastParts) {
  const Board chessboard = BoardFromArgument("chessboard:9x6:0.025");
  EXPECT_EQ(chessboard.type, BoardType::kChessboard);
  EXPECT_EQ(chessboard.columns, 9);
  EXPECT_EQ(chessboard.rows, 6);
  EXPECT_EQ(chessboard.square_size_m, 0.025);
  const Board charuco = BoardFromArgument("charuco:8x6:0.04");
  EXPECT_EQ(charuco.dictionary, "DICT_4X4_50") << "as a session without one";
  EXPECT_DOUBLE_EQ(charuco.tag_size_m, 0.028);
  EXPECT_EQ(BoardFromArgument("charuco:8x6:0.04:0.03:DICT_5X5_100").dictionary, "DICT_5X5_100");
  const Board grid = BoardFromArgument("aprilgrid:6x6:0.088");
  EXPECT_EQ(grid.tag_size_m, 0.088);
  EXPECT_EQ(grid.spacing, 0.3);
  EXPECT_EQ(BoardFromArgument("aprilgrid:6x5:0.088:0.2:tag25h9").family, "tag25h9");
}

TEST(BoardText, WhatIsWrittenIsReadAgain) {
  for (const char* text :
       {"chessboard:9x6:0.025", "charuco:8x6:0.04:0.03:DICT_5X5_100", "aprilgrid:6x6:0.088:0.25:tag36h11"})
    EXPECT_EQ(BoardArgument(BoardFromArgument(text)), text);
}

TEST(BoardText, FaultsNameWhatWasExpected) {
  EXPECT_THAT(Refusal("chesboard:9x6:0.025"), HasSubstr("did you mean \"chessboard\"?"));
  EXPECT_THAT(Refusal("chessboard:9:0.025"),
              HasSubstr("--board: expected COLUMNSxROWS such as 9x6, got \"9\""));
  EXPECT_THAT(Refusal("chessboard:9x6"), HasSubstr("expected chessboard:COLUMNSxROWS:SQUARE_M"));
  EXPECT_THAT(Refusal("chessboard:9x6:0.025:0.01"), HasSubstr("expected chessboard:COLUMNSxROWS:SQUARE_M"));
  EXPECT_THAT(Refusal("chessboard:9x6:25"), HasSubstr("in metres, got 25; write 0.025 for 25 mm"));
  EXPECT_THAT(Refusal("chessboard:9x6:x"), HasSubstr("expected the side of a square above 0, got \"x\""));
  EXPECT_THAT(Refusal("chessboard:2x6:0.025"),
              HasSubstr("columns: expected at least 3 inner corners, got 2"));
  EXPECT_THAT(Refusal("charuco:8x6:0.04:0.05"), HasSubstr("expected a marker smaller than its square"));
  EXPECT_THAT(Refusal("charuco:8x6:0.04:0.03:DICT_9"), HasSubstr("dictionary: expected one of DICT_4X4_50"));
}

}  // namespace
}  // namespace luxfit
