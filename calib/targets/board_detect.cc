#include "calib/targets/board.h"

#include <string>
#include <utility>

#include "calib/targets/internal/boards/april_grid.h"
#include "calib/targets/internal/boards/charuco_board.h"
#include "calib/targets/internal/boards/chessboard.h"
#include "calib/targets/internal/boards/corner_check.h"

namespace luxfit {
namespace {

BoardDetection DetectOfType(const ImagePlane& grey, const Board& board) {
  switch (board.type) {
    case BoardType::kAprilGrid:
      return DetectAprilGrid(grey, board);
    case BoardType::kChessboard:
      return DetectChessboard(grey, board);
    case BoardType::kCharuco:
      break;
  }
  return DetectCharuco(grey, board);
}

}  // namespace

BoardDetection DetectBoard(const ImagePlane& grey, const Board& board) {
  BoardCornerCounts(board);  // throws
  if (grey.size() == 0) return {{}, "the photo is empty"};
  BoardDetection detection = DetectOfType(grey, board);
  const std::size_t found = detection.corners.size();
  detection.corners = WithoutStrayCorners(board, static_cast<int>(grey.cols()), static_cast<int>(grey.rows()),
                                          std::move(detection.corners));
  const std::size_t strays = found - detection.corners.size();
  if (strays > 0)
    detection.message += (detection.message.empty() ? "" : "; ") + std::to_string(strays) +
                         " corners were left out: not where their neighbours put them";
  return detection;
}

}  // namespace luxfit
