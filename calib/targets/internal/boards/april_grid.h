// Finds AprilGrids in photos: any border width, with or without black squares between the tags.
//
// Tags are found in the photo at reduced size. Most of them decide how the tags are placed in the grid:
// Kalibr numbers from the bottom left, others from another corner, and tags are printed turned or not. Their
// corners are measured in the full photo: as saddles where a black square touches, else by fitting the tag's
// picture. Tags that were not found are searched for where their neighbours predict them.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_APRIL_GRID_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_APRIL_GRID_H_

#include <optional>

#include "calib/targets/board.h"

namespace luxfit {

// Detects the board, which must be an aprilgrid that BoardCorners accepts. The plane must not be empty.
BoardDetection DetectAprilGrid(const ImagePlane& grey, const Board& board);

// Returns the aprilgrid of any counts and family that the photo shows, with the expected one's sizes and first id; nothing
// where it shows none.
std::optional<Board> SearchAprilGrid(const ImagePlane& grey, const Board& expected);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_APRIL_GRID_H_
