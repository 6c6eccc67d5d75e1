// Finds ChArUco boards in photos.
//
// OpenCV 4.6 interpolates the inner corners half a pixel off. Here markers only tell where a corner must be,
// and the saddle found there is the corner. Which squares hold the markers differs with OpenCV's version on
// boards of an even number of rows; most markers decide.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_CHARUCO_BOARD_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_CHARUCO_BOARD_H_

#include <optional>

#include "calib/targets/board.h"

namespace luxfit {

// Detects the board, which must be a charuco that BoardCorners accepts. The plane must not be empty.
BoardDetection DetectCharuco(const ImagePlane& grey, const Board& board);

// Returns the charuco board of any counts and dictionary that the photo shows, with the expected one's sizes and first id;
// nothing where it shows none.
std::optional<Board> SearchCharuco(const ImagePlane& grey, const Board& expected);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_CHARUCO_BOARD_H_
