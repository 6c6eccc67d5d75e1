// What each lens makes of a direction, before focal lengths and centre: (x', y') of calib/lens/camera.h.
//
// Derivatives are those of (x', y') with respect to the point (X, Y, Z) in the camera frame. All return NaN
// where the lens has no image. LensDirection inverts LensImage and gives a direction of any length.
#ifndef LUXFIT_CALIB_LENS_INTERNAL_LENS_H_
#define LUXFIT_CALIB_LENS_INTERNAL_LENS_H_

#include <Eigen/Core>
#include <limits>

#include "calib/lens/camera.h"

namespace luxfit {

// Of what the lens has no image of.
inline constexpr double kNoImage = std::numeric_limits<double>::quiet_NaN();

struct LensImage {
  Eigen::Vector2d xy;
  Eigen::Matrix<double, 2, 3> d_point;
};

LensImage OpenCvLensImage(const Camera& camera, const Eigen::Vector3d& p_in_cam);
Eigen::Vector3d OpenCvLensDirection(const Camera& camera, const Eigen::Vector2d& xy);

LensImage FisheyeLensImage(const Camera& camera, const Eigen::Vector3d& p_in_cam);
Eigen::Vector3d FisheyeLensDirection(const Camera& camera, const Eigen::Vector2d& xy);

// By libmrcal.
LensImage SplinedLensImage(const Camera& camera, const Eigen::Vector3d& p_in_cam);
Eigen::Vector3d SplinedLensDirection(const Camera& camera, const Eigen::Vector2d& xy);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_INTERNAL_LENS_H_
