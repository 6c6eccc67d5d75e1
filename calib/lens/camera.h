// Projects points in front of a lens to pixels, and pixels back to rays.
//
//   pixel = (fx x', fy y') + (cx, cy),   (x', y'): the lens' image of the direction (X, Y, Z):
//
//   kOpenCv   x = X/Z, y = Y/Z, r2 = x^2 + y^2
//             d  = (1 + k1 r2 + k2 r2^2 + k3 r2^3) / (1 + k4 r2 + k5 r2^2 + k6 r2^3)
//             x' = x d + 2 p1 x y + p2 (r2 + 2 x^2) + s1 r2 + s2 r2^2
//             y' = y d + p1 (r2 + 2 y^2) + 2 p2 x y + s3 r2 + s4 r2^2
//   kFisheye  theta = angle from the axis, (x', y') = (X, Y) / sqrt(X^2 + Y^2)
//                     * theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8)
//   kSplined  (x', y') = u + B-spline surface at u, u = 2 tan(theta / 2) (X, Y) / sqrt(X^2 + Y^2); without
//             control points a plain stereographic lens
//
// Camera frame: x right, y down, z forward, metres. Pixel (0, 0) is the centre of the top-left pixel.
// Results are NaN where the lens has no image or no inverse.
// Source: OpenCV 4.6 documentation, calib3d and fisheye, "Detailed Description"; Brown (1971), "Close-range
// camera calibration"; Kannala and Brandt (2006), "A generic camera model"; mrcal 2.2,
// LENSMODEL_SPLINED_STEREOGRAPHIC.
#ifndef LUXFIT_CALIB_LENS_CAMERA_H_
#define LUXFIT_CALIB_LENS_CAMERA_H_

#include <Eigen/Core>
#include <array>
#include <vector>

namespace luxfit {

enum class LensModel { kOpenCv, kFisheye, kSplined };

// Holds a splined lens' configuration and control points, as mrcal defines them.
struct LensSpline {
  int order = 3;                       // 2 or 3
  int nx = 0, ny = 0;                  // control points along x and y
  int fov_x_deg = 0;                   // field of view that the control points cover
  std::vector<double> control_points;  // 2 nx ny: (x, y) of each, row by row; empty: none
};

struct Camera {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  // kOpenCv: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4, the order of OpenCV and mrcal; kFisheye: k1 k2 k3 k4.
  // Unused coefficients are 0.
  std::array<double, 12> distortion{};
  LensModel lens = LensModel::kOpenCv;
  LensSpline spline;  // kSplined only
};

// Returns the camera with its fx and fy multiplied by `scale`.
Camera WithFocalScale(Camera camera, double scale);

// Returns the pixel of a point in the camera frame. The pixel is NaN where the lens has no image of the
// point: Z <= 0 for kOpenCv, the axis behind the camera for the other lenses.
Eigen::Vector2d Project(const Camera& camera, const Eigen::Vector3d& p_in_cam);

// Holds a pixel and d(pixel)/d(p_in_cam), 2 x 3, px/m.
struct Projection {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> d_pixel_d_point;
};
// Returns the same pixel with its derivative; NaN where Project is.
Projection ProjectWithJacobian(const Camera& camera, const Eigen::Vector3d& p_in_cam);

// Returns the unit direction, in the camera frame, of the ray through a pixel. Inverts Project by Newton's
// method to 1e-9 px. NaN where the lens has no inverse (outside the monotonic field of view).
Eigen::Vector3d Unproject(const Camera& camera, const Eigen::Vector2d& pixel);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_CAMERA_H_
