// The inner corners of a chequered pattern, measured where they are expected.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_CHECKER_CORNER_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_CHECKER_CORNER_H_

#include <Eigen/Core>
#include <optional>

#include "calib/luminance/image.h"
#include "calib/targets/internal/saddle.h"

namespace luxfit {

struct CheckerCorner {
  Eigen::Vector2d place_m;        // on the board
  bool is_top_left_black = true;  // its top-left (and bottom-right) square
  double clear_m = 0;             // nothing but the four squares within it, both ways
};

// The saddle near where `pixel_from_board` puts the corner; nothing where the four squares about it do not
// have their colours, or no saddle is found.
std::optional<Saddle> MeasureCheckerCorner(const ImagePlane& grey, const Eigen::Matrix3d& pixel_from_board,
                                           const CheckerCorner& corner);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_CHECKER_CORNER_H_
