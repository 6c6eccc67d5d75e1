// Estimates how a lens bends straight lines from one plane's own corners; it is not a calibration.
//
//   pixel = c + f (x d, y d),  (x, y) = H p,  d = 1 + k1 r^2 + k2 r^4,  r^2 = x^2 + y^2
//
// c is the middle of the photo and f its longer side. Unknowns: H (8), k1, k2; least squares, Huber.
//
// Source: Brown (1971), "Close-range camera calibration".
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_PLANE_LENS_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_PLANE_LENS_H_

#include <Eigen/Core>
#include <vector>

#include "calib/lens/camera.h"

namespace luxfit {

// Returns a camera with that distortion. Returns one without distortion where the corners are too few to show
// it or fit no better with it.
Camera LensOfPlane(int width_px, int height_px, const std::vector<Eigen::Vector2d>& places_m,
                   const std::vector<Eigen::Vector2d>& pixels);

// Returns the pixel as the same camera without distortion would show it. Returns the pixel itself where the
// lens has no inverse.
Eigen::Vector2d Straightened(const Camera& lens, const Eigen::Vector2d& pixel);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_PLANE_LENS_H_
