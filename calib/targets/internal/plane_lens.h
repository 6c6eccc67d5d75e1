// What a lens makes of one plane, from that plane's own corners: enough to know how straight lines bend, not
// a calibration.
//
//   pixel = c + f (x d, y d),  (x, y) = H p,  d = 1 + k1 r^2 + k2 r^4,  r^2 = x^2 + y^2
//
// with c the middle of the photo and f its longer side. Unknowns: H (8), k1, k2; least squares, Huber.
//
// Source: Brown (1971), "Close-range camera calibration".
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_PLANE_LENS_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_PLANE_LENS_H_

#include <Eigen/Core>
#include <vector>

#include "calib/lens/camera.h"

namespace luxfit {

// A camera with that distortion; without any where the corners are too few to show it or fit no better with
// it.
Camera LensOfPlane(int width_px, int height_px, const std::vector<Eigen::Vector2d>& places_m,
                   const std::vector<Eigen::Vector2d>& pixels);

// The pixel as the same camera without distortion would show it; itself where the lens has no inverse.
Eigen::Vector2d Straightened(const Camera& lens, const Eigen::Vector2d& pixel);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_PLANE_LENS_H_
