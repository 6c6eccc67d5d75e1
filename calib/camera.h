// Pinhole camera with the OpenCV distortion polynomial.
//
//   x = X/Z, y = Y/Z, r2 = x^2 + y^2
//   d = (1 + k1 r2 + k2 r2^2 + k3 r2^3) / (1 + k4 r2 + k5 r2^2 + k6 r2^3)
//   u = fx (x d + 2 p1 x y + p2 (r2 + 2 x^2)) + cx
//   v = fy (y d + p1 (r2 + 2 y^2) + 2 p2 x y) + cy
//
// Camera frame: x right, y down, z forward, metres. Pixels: (0, 0) is the centre of the top-left pixel.
// Source: OpenCV 4.6 documentation, calib3d, "Detailed Description"; Brown (1971), "Close-range camera
// calibration".
#ifndef LUXFIT_CALIB_CAMERA_H_
#define LUXFIT_CALIB_CAMERA_H_

#include <Eigen/Core>
#include <array>
#include <string>

namespace luxfit {

struct Camera {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  // k1 k2 p1 p2 k3 k4 k5 k6, OpenCV's order; unused ones are 0.
  std::array<double, 8> distortion{};
};

// Pixel of a point in the camera frame. Undefined (NaN) for points that are not in front of the camera (Z <=
// 0).
Eigen::Vector2d Project(const Camera& camera, const Eigen::Vector3d& p_in_cam);

// The same with d(pixel)/d(p_in_cam), 2 x 3.
struct Projection {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> d_pixel_d_point;
};
Projection ProjectWithJacobian(const Camera& camera, const Eigen::Vector3d& p_in_cam);

// Unit direction in the camera frame of the ray through a pixel; inverts Project by Newton's method to 1e-10.
// NaN where the distortion polynomial has no inverse (outside the monotonic field of view).
Eigen::Vector3d Unproject(const Camera& camera, const Eigen::Vector2d& pixel);

// Reads an OpenCV YAML/XML calibration: camera_matrix, distortion_coefficients (4, 5 or 8), image_width,
// image_height. Throws std::runtime_error naming file, key and what was expected.
Camera ReadOpenCvCamera(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CAMERA_H_
