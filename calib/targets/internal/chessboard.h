// Chessboards in photos, seen whole.
//
// Corners are numbered so that the square at the outside of the first one is black, where that tells the
// board from itself turned by 180 degrees (one count of inner corners odd, the other even). Where it does
// not, the row that points right in the photo is taken: then all cameras of a rig must be upright, and photos
// not turned by more than 90 degrees.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_CHESSBOARD_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_CHESSBOARD_H_

#include "calib/targets/board.h"

namespace luxfit {

// The board must be a chessboard that BoardCorners accepts, the plane not empty.
BoardDetection DetectChessboard(const ImagePlane& grey, const Board& board);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_CHESSBOARD_H_
