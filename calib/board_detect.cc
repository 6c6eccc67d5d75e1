#include "calib/board.h"
#include "calib/internal/april_grid.h"
#include "calib/internal/charuco_board.h"
#include "calib/internal/chessboard.h"

namespace luxfit {

BoardDetection DetectBoard(const ImagePlane& grey, const Board& board) {
  BoardCornerCounts(board);  // throws
  BoardDetection detection;
  if (grey.size() == 0) {
    detection.message = "the photo is empty";
    return detection;
  }
  switch (board.type) {
    case BoardType::kAprilGrid:
      return DetectAprilGrid(grey, board);
    case BoardType::kChessboard:
      return DetectChessboard(grey, board);
    case BoardType::kCharuco:
      return DetectCharuco(grey, board);
  }
  return detection;
}

}  // namespace luxfit
