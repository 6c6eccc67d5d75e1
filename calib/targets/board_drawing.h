// What is black on a printed board or tag.
//
// On the board: x right, y down, metres, from the board's own origin (board.h). Rectangles do not overlap,
// but touch: drawn as one path they leave no seams.
#ifndef LUXFIT_CALIB_TARGETS_BOARD_DRAWING_H_
#define LUXFIT_CALIB_TARGETS_BOARD_DRAWING_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/targets/board.h"

namespace luxfit {

struct BlackRectangle {
  Eigen::Vector2d min_m, max_m;
};

struct BoardDrawing {
  std::vector<BlackRectangle> black;
  Eigen::Vector2d min_m, max_m;  // of all that is black
  double margin_m = 0;           // of white that detection needs around it
};

struct BoardStyle {     // aprilgrid only
  int border_bits = 1;  // 2: as Kalibr prints, which libapriltag does not detect
  bool has_corner_squares =
      false;  // black squares between the tags' corners: libapriltag finds few tags then
};

// Tags upright, ids from the bottom left; the top-left square of a chessboard and of a charuco black. Throws
// std::invalid_argument as BoardCorners does, and for gaps between tags that are too narrow to be seen.
BoardDrawing DrawBoard(const Board& board, const BoardStyle& style = {});

// One tag, its black square's top-left corner at the origin. Throws std::invalid_argument for an unknown
// family or id and a size that is not > 0.
BoardDrawing DrawSingleTag(const std::string& family, int id, double size_m);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_BOARD_DRAWING_H_
