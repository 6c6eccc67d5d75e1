// Finds where two black and two white fields meet, from the gradients about it.
//
// Every gradient g at p near the corner q is perpendicular to p - q (it is zero inside fields):
//   q = argmin sum w (g . (p - q))^2 = (sum w g g^T)^-1 sum w g g^T p
// w are Gaussian weights over a window that holds nothing but the four fields. Blur and a monotonic curve of
// the grey values leave q where it is, since they act on both sides of the corner alike.
//
// sigma: the picture about a saddle looks the same turned by 180 degrees. The rest is noise (or print,
// texture, a shadow), which the equation above propagates to q. A floor allows for aliasing and flatness.
//
// Source: Foerstner and Guelch (1987), "A fast operator for detection and precise location of distinct
// points".
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_SADDLE_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_SADDLE_H_

#include <Eigen/Core>
#include <optional>

#include "calib/photo_files/image.h"

namespace luxfit {

struct Saddle {
  Eigen::Vector2d pixel;
  double sigma_px = 0;  // per axis
};

// Returns the saddle near `start`. Returns nothing where the window leaves the plane, holds pixels that are
// not finite or no saddle, or the corner drifts away.
std::optional<Saddle> RefineSaddle(const ImagePlane& grey, const Eigen::Vector2d& start,
                                   double half_window_px);
// Returns the same by the largest window whose image on the board stays within `clear` of `place`, where only
// the four fields are.
std::optional<Saddle> RefineSaddle(const ImagePlane& grey, const Eigen::Vector2d& start,
                                   const Eigen::Matrix3d& pixel_from_board, const Eigen::Vector2d& place,
                                   double clear);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_SADDLE_H_
