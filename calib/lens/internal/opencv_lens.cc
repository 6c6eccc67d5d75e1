#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "calib/lens/internal/lens.h"

namespace luxfit {
namespace {

struct Distorted {
  Eigen::Vector2d value;
  Eigen::Matrix2d jacobian;  // d value / d (x, y)
};

Distorted Distort(const std::array<double, 12>& k, const Eigen::Vector2d& xy) {
  const double x = xy.x(), y = xy.y(), r2 = xy.squaredNorm();
  const double p1 = k[2], p2 = k[3];
  const double numerator = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double denominator = 1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]));
  const double d = numerator / denominator;
  const double d_numerator = k[0] + r2 * (2 * k[1] + 3 * r2 * k[4]);
  const double d_denominator = k[5] + r2 * (2 * k[6] + 3 * r2 * k[7]);
  const double d_r2 = (d_numerator - d * d_denominator) / denominator;  // d(d) / d(r2)
  const Eigen::Vector2d prism(r2 * (k[8] + r2 * k[9]), r2 * (k[10] + r2 * k[11]));
  const Eigen::Vector2d prism_r2(k[8] + 2 * r2 * k[9], k[10] + 2 * r2 * k[11]);  // d(prism) / d(r2)

  Distorted out;
  out.value = prism + Eigen::Vector2d(x * d + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                                      y * d + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y);
  const double cross = 2 * x * y * d_r2 + 2 * p1 * x + 2 * p2 * y;
  out.jacobian << d + 2 * x * x * d_r2 + 2 * p1 * y + 6 * p2 * x, cross, cross,
      d + 2 * y * y * d_r2 + 6 * p1 * y + 2 * p2 * x;
  out.jacobian += 2 * prism_r2 * xy.transpose();
  return out;
}

// Returns whether r d(r) grows from the axis out to xy, so that xy lies on the branch of a real lens.
bool IsOnFirstBranch(const std::array<double, 12>& k, const Eigen::Vector2d& xy) {
  constexpr int kSteps = 8;
  for (int i = 1; i <= kSteps; ++i) {
    if (Distort(k, xy * (static_cast<double>(i) / kSteps)).jacobian.determinant() <= 0) return false;
  }
  return true;
}

LensImage OpenCvImage(const Camera& camera, const Eigen::Vector3d& p_in_cam) {
  LensImage out;
  if (!(p_in_cam.z() > 0)) {
    out.xy.setConstant(kNoImage);
    out.d_point.setConstant(kNoImage);
    return out;
  }
  const double inverse_z = 1 / p_in_cam.z();
  const Eigen::Vector2d xy = p_in_cam.head<2>() * inverse_z;
  const Distorted distorted = Distort(camera.distortion, xy);
  Eigen::Matrix<double, 2, 3> d_xy;
  d_xy << inverse_z, 0, -xy.x() * inverse_z, 0, inverse_z, -xy.y() * inverse_z;
  out.xy = distorted.value;
  out.d_point = distorted.jacobian * d_xy;
  return out;
}

Eigen::Vector3d OpenCvDirection(const Camera& camera, const Eigen::Vector2d& target) {
  Eigen::Vector3d none = Eigen::Vector3d::Constant(kNoImage);
  // Two fixed-point steps, which take the distortion at the target for that at the root, start Newton's
  // method near the root.
  Eigen::Vector2d xy = target;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d next = xy - (Distort(camera.distortion, xy).value - target);
    if (!next.allFinite() || next.norm() > 2 * target.norm() + 1) break;
    xy = next;
  }
  constexpr int kMaxIterations = 30;
  constexpr double kTolerance = 1e-12;  // in the image plane z = 1: at most 1e-9 px
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
  return {xy.x(), xy.y(), 1};
}

// Returns the k1, k2 that bring a pinhole nearest to the stereographic lens, over the angles that it sees:
//   tan(theta) (1 + k1 tan^2 + k2 tan^4) = 2 tan(theta / 2)
std::vector<double> LikeStereographic(double half_field_rad) {
  constexpr double kWidest = 1.1;  // rad: beyond, two coefficients cannot follow
  constexpr int kSteps = 20;
  const double most = std::min(kWidest, half_field_rad);
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  for (int i = 1; i <= kSteps; ++i) {
    const double theta = most * i / kSteps, r = std::tan(theta);
    const Eigen::Vector2d d(r * r * r, std::pow(r, 5));
    hessian += d * d.transpose();
    gradient += d * (2 * std::tan(theta / 2) - r);
  }
  const Eigen::Vector2d k = hessian.inverse() * gradient;
  return {k[0], k[1]};
}

}  // namespace

LensOps OpenCvLens() {
  LensOps ops;
  ops.lens = LensModel::kOpenCv;
  ops.key = "opencv";
  ops.size = &LensKind::coefficients;
  ops.has_size = [](int size) { return size == 4 || size == 5 || size == 8 || size == 12; };
  ops.tried_sizes = {4, 5, 8, 12};
  ops.coefficients = 12;
  ops.coefficient_names = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4"};
  ops.is_pinhole = true;
  ops.is_nested = true;
  ops.is_in_mrcal = true;
  ops.is_in_opencv = true;
  ops.image = OpenCvImage;
  ops.direction = OpenCvDirection;
  ops.like_stereographic = LikeStereographic;
  return ops;
}

}  // namespace luxfit
