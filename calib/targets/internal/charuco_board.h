// ChArUco boards in photos.
//
// OpenCV 4.6 interpolates the inner corners half a pixel off; here markers only say where a corner must be,
// and the saddle found there is the corner. Which squares hold the markers (it differs with OpenCV's version
// on boards of an even number of rows) is what most markers agree on.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_CHARUCO_BOARD_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_CHARUCO_BOARD_H_

#include "calib/targets/board.h"

namespace luxfit {

// The board must be a charuco that BoardCorners accepts, the plane not empty.
BoardDetection DetectCharuco(const ImagePlane& grey, const Board& board);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_CHARUCO_BOARD_H_
