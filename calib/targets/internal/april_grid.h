// AprilGrids in photos: any border width, with or without black squares between the tags.
//
// Tags are found in the photo at reduced size; how the tags stand in the grid (Kalibr numbers from the bottom
// left, others from another corner; printed turned or not) is what most of them agree on. Their corners are
// measured in the full photo: as saddles where a black square touches, else by fitting the tag's picture.
// Tags that were not found are looked for where their neighbours say they must be.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_APRIL_GRID_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_APRIL_GRID_H_

#include "calib/targets/board.h"

namespace luxfit {

// The board must be an aprilgrid that BoardCorners accepts, the plane not empty.
BoardDetection DetectAprilGrid(const ImagePlane& grey, const Board& board);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_APRIL_GRID_H_
