// Measures the inner corners of a chequered pattern near their predicted places.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_CHECKER_CORNER_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_CHECKER_CORNER_H_

#include <Eigen/Core>
#include <optional>

#include "calib/photo_files/image.h"
#include "calib/targets/internal/boards/saddle.h"

namespace luxfit {

struct CheckerCorner {
  Eigen::Vector2d place_m;        // on the board
  bool is_top_left_black = true;  // colour of its top-left (and bottom-right) square
  double clear_m = 0;             // only the four squares lie within it, both ways
};

// Returns the saddle near the place that `pixel_from_board` gives the corner. Returns nothing where the four
// squares about it do not have their colours, or no saddle is found.
std::optional<Saddle> MeasureCheckerCorner(const ImagePlane& grey, const Eigen::Matrix3d& pixel_from_board,
                                           const CheckerCorner& corner);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_CHECKER_CORNER_H_
