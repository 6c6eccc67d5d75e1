// Makes a pinhole camera.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_PINHOLE_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_PINHOLE_H_

#include <Eigen/Core>

#include "calib/lens/camera.h"

namespace luxfit::support {

// `f_px`: of both axes.
inline Camera Pinhole(int width_px, int height_px, double f_px, const Eigen::Vector2d& centre_px) {
  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px = camera.fy_px = f_px;
  camera.cx_px = centre_px.x();
  camera.cy_px = centre_px.y();
  return camera;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_PINHOLE_H_
