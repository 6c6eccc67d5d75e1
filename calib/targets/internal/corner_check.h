// Corners that do not lie where their neighbours put them: an occluder's edge, a shadow, a tag half hidden.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_CORNER_CHECK_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_CORNER_CHECK_H_

#include <vector>

#include "calib/targets/board.h"

namespace luxfit {

// The corners that agree with a homography through their nearest neighbours (of other tags, for those of one
// tag may err together) to 0.3 px and 6 times the board's median: lenses and bent paper leave smooth
// deviations, which neighbours share. The worst is left out first, for it spoils its neighbours'
// homographies.
std::vector<BoardCorner> WithoutStrayCorners(const Board& board, int width_px, int height_px,
                                             std::vector<BoardCorner> corners);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_CORNER_CHECK_H_
