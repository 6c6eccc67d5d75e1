#include "calib/camera.h"

#include <Eigen/LU>
#include <cmath>
#include <fstream>
#include <limits>
#include <opencv2/core.hpp>
#include <stdexcept>

namespace luxfit {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Distorted {
  Eigen::Vector2d value;
  Eigen::Matrix2d jacobian;  // d value / d (x, y)
};

Distorted Distort(const std::array<double, 8>& k, const Eigen::Vector2d& xy) {
  const double x = xy.x(), y = xy.y(), r2 = xy.squaredNorm();
  const double p1 = k[2], p2 = k[3];
  const double numerator = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double denominator = 1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]));
  const double d = numerator / denominator;
  const double d_numerator = k[0] + r2 * (2 * k[1] + 3 * r2 * k[4]);
  const double d_denominator = k[5] + r2 * (2 * k[6] + 3 * r2 * k[7]);
  const double d_r2 = (d_numerator - d * d_denominator) / denominator;  // d(d) / d(r2)

  Distorted out;
  out.value = {x * d + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
               y * d + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
  const double cross = 2 * x * y * d_r2 + 2 * p1 * x + 2 * p2 * y;
  out.jacobian << d + 2 * x * x * d_r2 + 2 * p1 * y + 6 * p2 * x, cross, cross,
      d + 2 * y * y * d_r2 + 6 * p1 * y + 2 * p2 * x;
  return out;
}

// Whether r d(r) grows from the axis out to xy, so that xy lies on the branch a lens really has.
bool IsOnFirstBranch(const std::array<double, 8>& k, const Eigen::Vector2d& xy) {
  constexpr int kSteps = 8;
  for (int i = 1; i <= kSteps; ++i) {
    if (Distort(k, xy * (static_cast<double>(i) / kSteps)).jacobian.determinant() <= 0) return false;
  }
  return true;
}

[[noreturn]] void Fail(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what);
}

int ReadPixels(const cv::FileStorage& file, const std::string& path, const std::string& key) {
  const cv::FileNode node = file[key];
  if (!node.isInt() && !node.isReal()) {
    Fail(path, key + ": expected a number of pixels, got " + (node.empty() ? "nothing" : "something else"));
  }
  const double value = static_cast<double>(node);
  if (!(value >= 1) || value != std::floor(value)) {
    Fail(path, key + ": expected a whole number > 0, got " + std::to_string(value));
  }
  return static_cast<int>(value);
}

cv::Mat ReadMatrix(const cv::FileStorage& file, const std::string& path, const std::string& key) {
  const cv::FileNode node = file[key];
  if (node.empty()) {
    Fail(path, key + ": expected an !!opencv-matrix, got nothing; is this a calibration written by OpenCV?");
  }
  cv::Mat matrix;
  if (node.isMap()) node >> matrix;
  if (matrix.empty() || matrix.channels() != 1) Fail(path, key + ": expected an !!opencv-matrix of numbers");
  matrix.convertTo(matrix, CV_64F);
  for (int row = 0; row < matrix.rows; ++row) {
    for (int col = 0; col < matrix.cols; ++col) {
      if (!std::isfinite(matrix.at<double>(row, col))) Fail(path, key + ": expected finite numbers");
    }
  }
  return matrix;
}

void ReadIntrinsics(const cv::FileStorage& file, const std::string& path, Camera& camera) {
  const std::string key = "camera_matrix";
  const cv::Mat k = ReadMatrix(file, path, key);
  if (k.rows != 3 || k.cols != 3) {
    Fail(path, key + ": expected 3 x 3, got " + std::to_string(k.rows) + " x " + std::to_string(k.cols));
  }
  camera.fx_px = k.at<double>(0, 0);
  camera.fy_px = k.at<double>(1, 1);
  camera.cx_px = k.at<double>(0, 2);
  camera.cy_px = k.at<double>(1, 2);
  if (!(camera.fx_px > 0 && camera.fy_px > 0)) {
    Fail(path, key + ": expected focal lengths > 0 px, got " + std::to_string(camera.fx_px) + " and " +
                   std::to_string(camera.fy_px));
  }
  if (k.at<double>(0, 1) != 0 || k.at<double>(1, 0) != 0 || k.at<double>(2, 0) != 0 ||
      k.at<double>(2, 1) != 0 || k.at<double>(2, 2) != 1) {
    Fail(path, key + ": expected [fx 0 cx; 0 fy cy; 0 0 1] without skew");
  }
}

void ReadDistortion(const cv::FileStorage& file, const std::string& path, Camera& camera) {
  const std::string key = "distortion_coefficients";
  const cv::Mat k = ReadMatrix(file, path, key);
  const int count = static_cast<int>(k.total());
  if ((k.rows != 1 && k.cols != 1) || (count != 4 && count != 5 && count != 8)) {
    Fail(path, key + ": expected 4, 5 or 8 in one row or column, got " + std::to_string(k.rows) + " x " +
                   std::to_string(k.cols));
  }
  for (int i = 0; i < count; ++i) {
    camera.distortion[static_cast<std::size_t>(i)] = k.rows == 1 ? k.at<double>(0, i) : k.at<double>(i, 0);
  }
}

}  // namespace

Projection ProjectWithJacobian(const Camera& camera, const Eigen::Vector3d& p_in_cam) {
  Projection out;
  if (!(p_in_cam.z() > 0)) {
    out.pixel.setConstant(kNaN);
    out.d_pixel_d_point.setConstant(kNaN);
    return out;
  }
  const double inverse_z = 1 / p_in_cam.z();
  const Eigen::Vector2d xy = p_in_cam.head<2>() * inverse_z;
  const Distorted distorted = Distort(camera.distortion, xy);
  const Eigen::Vector2d focal_px(camera.fx_px, camera.fy_px);
  out.pixel = focal_px.cwiseProduct(distorted.value) + Eigen::Vector2d(camera.cx_px, camera.cy_px);
  Eigen::Matrix<double, 2, 3> d_xy;
  d_xy << inverse_z, 0, -xy.x() * inverse_z, 0, inverse_z, -xy.y() * inverse_z;
  out.d_pixel_d_point = focal_px.asDiagonal() * distorted.jacobian * d_xy;
  return out;
}

Eigen::Vector2d Project(const Camera& camera, const Eigen::Vector3d& p_in_cam) {
  if (!(p_in_cam.z() > 0)) return Eigen::Vector2d::Constant(kNaN);
  const Eigen::Vector2d distorted = Distort(camera.distortion, p_in_cam.head<2>() / p_in_cam.z()).value;
  return {camera.fx_px * distorted.x() + camera.cx_px, camera.fy_px * distorted.y() + camera.cy_px};
}

Eigen::Vector3d Unproject(const Camera& camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d target((pixel.x() - camera.cx_px) / camera.fx_px,
                               (pixel.y() - camera.cy_px) / camera.fy_px);
  Eigen::Vector3d none = Eigen::Vector3d::Constant(kNaN);
  if (!target.allFinite()) return none;

  // Two fixed-point steps (as if the distortion were the same at the target) put Newton's method near the
  // root.
  Eigen::Vector2d xy = target;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d next = xy - (Distort(camera.distortion, xy).value - target);
    if (!next.allFinite() || next.norm() > 2 * target.norm() + 1) break;
    xy = next;
  }
  constexpr int kMaxIterations = 30;
  constexpr double kTolerance = 1e-12;  // of the image plane at z = 1: 1e-9 px at most
  bool converged = false;
  for (int i = 0; i < kMaxIterations && !converged; ++i) {
    const Distorted distorted = Distort(camera.distortion, xy);
    const double determinant = distorted.jacobian.determinant();
    if (!(std::abs(determinant) > 1e-9)) return none;
    const Eigen::Vector2d residual = distorted.value - target;
    xy -= distorted.jacobian.inverse() * residual;
    if (!xy.allFinite()) return none;
    converged = residual.norm() < kTolerance;
  }
  if (!converged || !IsOnFirstBranch(camera.distortion, xy)) return none;
  return Eigen::Vector3d(xy.x(), xy.y(), 1).normalized();
}

Camera ReadOpenCvCamera(const std::string& path) {
  if (!std::ifstream(path))
    Fail(path, "cannot read the calibration, expected an existing file that may be read");
  try {
    const cv::FileStorage file(path, cv::FileStorage::READ);
    if (!file.isOpened()) Fail(path, "cannot read the calibration, expected an OpenCV YAML or XML file");
    Camera camera;
    camera.width_px = ReadPixels(file, path, "image_width");
    camera.height_px = ReadPixels(file, path, "image_height");
    ReadIntrinsics(file, path, camera);
    ReadDistortion(file, path, camera);
    return camera;
  } catch (const cv::Exception& e) {
    Fail(path, "cannot read the calibration, expected OpenCV YAML (first line %YAML:1.0) or XML: " + e.err);
  }
}

}  // namespace luxfit
