// The camera of fixtures/office at its full resolution, with the distortion that a test asks for (OpenCV's
// order).
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_OFFICE_CAMERA_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_OFFICE_CAMERA_H_

#include <array>

#include "calib/lens/camera.h"

namespace luxfit {

inline Camera OfficeCamera(const std::array<double, 12>& distortion) {
  Camera camera;
  camera.width_px = 960;
  camera.height_px = 720;
  camera.fx_px = 742;
  camera.fy_px = 741.2;
  camera.cx_px = 483.1;
  camera.cy_px = 356.4;
  camera.distortion = distortion;
  return camera;
}

}  // namespace luxfit

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_OFFICE_CAMERA_H_
