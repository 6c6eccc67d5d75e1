// Finds chessboards in photos that show them whole.
//
// Corners are numbered so that the square outside the first one is black. That tells the board from itself
// turned by 180 degrees where one count of inner corners is odd and the other even. Otherwise the row that
// points right in the photo is chosen. Then all cameras of a rig must be upright, and photos not turned by
// more than 90 degrees.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_CHESSBOARD_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_CHESSBOARD_H_

#include <optional>

#include "calib/targets/board.h"

namespace luxfit {

// Detects the board, which must be a chessboard that BoardCorners accepts. The plane must not be empty.
BoardDetection DetectChessboard(const ImagePlane& grey, const Board& board);

// Returns the chessboard of any counts that the photo shows, its longer side along that of the expected one; nothing
// where it shows none.
std::optional<Board> SearchChessboard(const ImagePlane& grey, const Board& expected);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_CHESSBOARD_H_
