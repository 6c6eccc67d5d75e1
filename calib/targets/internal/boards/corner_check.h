// Leaves out corners that do not lie where their neighbours predict them.
//
// Such corners are an occluder's edge, a shadow, or part of a tag that is half hidden.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_CORNER_CHECK_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_CORNER_CHECK_H_

#include <vector>

#include "calib/targets/board.h"

namespace luxfit {

// Returns the corners that agree with a homography through their nearest neighbours, to 0.3 px and 6 times
// the board's median. Neighbours are of other tags, since those of one tag may err together. Lenses and bent
// paper leave smooth deviations, which neighbours share. The worst corner is left out first, since it spoils
// its neighbours' homographies.
std::vector<BoardCorner> WithoutStrayCorners(const Board& board, int width_px, int height_px,
                                             std::vector<BoardCorner> corners);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_CORNER_CHECK_H_
