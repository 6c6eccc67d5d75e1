#include <cmath>

#include "calib/lens/internal/lens.h"

namespace luxfit {
namespace {

constexpr int kCoefficients = 4;

struct Radius {
  double value = 0, slope = 0;  // theta (1 + k1 theta^2 + ...) and its derivative
};

Radius RadiusOf(const std::array<double, 12>& k, double theta) {
  const double t2 = theta * theta;
  return {theta * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3])))),
          1 + t2 * (3 * k[0] + t2 * (5 * k[1] + t2 * (7 * k[2] + t2 * 9 * k[3])))};
}

LensImage FisheyeImage(const Camera& camera, const Eigen::Vector3d& p_in_cam) {
  const Eigen::Vector2d across = p_in_cam.head<2>();
  const double r = across.norm(), z = p_in_cam.z(), length2 = p_in_cam.squaredNorm();
  LensImage out;
  if (r <= 1e-9 * std::abs(z) || !(length2 > 0)) {  // near the axis every lens is a pinhole
    const double inverse_z = z > 0 ? 1 / z : kNoImage;
    out.xy = across * inverse_z;
    out.d_point << inverse_z, 0, -out.xy.x() * inverse_z, 0, inverse_z, -out.xy.y() * inverse_z;
    return out;
  }
  const Radius radius = RadiusOf(camera.distortion, std::atan2(r, z));
  const double scale = radius.value / r;
  const double d_scale = (radius.slope * z / length2 - scale) / (r * r);  // d(scale) / d(r), over r
  out.xy = scale * across;
  out.d_point.leftCols<2>() = scale * Eigen::Matrix2d::Identity() + d_scale * across * across.transpose();
  out.d_point.col(2) = -radius.slope / length2 * across;
  return out;
}

Eigen::Vector3d FisheyeDirection(const Camera& camera, const Eigen::Vector2d& xy) {
  const double target = xy.norm();
  if (target < 1e-12) return {xy.x(), xy.y(), 1};
  Eigen::Vector3d none = Eigen::Vector3d::Constant(kNoImage);
  // Bracket the first angle at which the radius reaches the target, while the radius still grows.
  constexpr int kSteps = 64;
  double low = 0, high = kNoImage;
  for (int i = 1; i <= kSteps && std::isnan(high); ++i) {
    const double theta = M_PI * i / kSteps;
    const Radius radius = RadiusOf(camera.distortion, theta);
    if (radius.value >= target) {
      high = theta;
    } else if (radius.slope <= 0) {
      return none;
    } else {
      low = theta;
    }
  }
  if (std::isnan(high)) return none;
  double theta = (low + high) / 2;
  constexpr int kMaxIterations = 60;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Radius radius = RadiusOf(camera.distortion, theta);
    const double residual = radius.value - target;
    (residual > 0 ? high : low) = theta;
    if (std::abs(residual) < 1e-14) break;
    const double next = theta - residual / radius.slope;
    theta = next > low && next < high ? next : (low + high) / 2;  // Newton's step where it stays inside
  }
  const Eigen::Vector2d across = std::sin(theta) / target * xy;
  return {across.x(), across.y(), std::cos(theta)};
}

Eigen::Matrix2Xd DCoefficients(const Camera&, const Eigen::Vector3d& p_in_cam) {
  Eigen::Matrix2Xd out = Eigen::Matrix2Xd::Zero(2, kCoefficients);
  const double r = p_in_cam.head<2>().norm();
  if (r == 0) return out;
  const double theta = std::atan2(r, p_in_cam.z());
  double power = theta;
  for (int i = 0; i < kCoefficients; ++i) {
    power *= theta * theta;
    out.col(i) = p_in_cam.head<2>() * (power / r);
  }
  return out;
}

}  // namespace

LensOps FisheyeLens() {
  LensOps ops;
  ops.lens = LensModel::kFisheye;
  ops.key = "fisheye";
  ops.tried_sizes = {kCoefficients};
  ops.is_tried_on_wide_fields_only = true;
  ops.coefficients = kCoefficients;
  ops.coefficient_names = {"k1", "k2", "k3", "k4"};
  ops.distortion_model = "equidistant";
  ops.is_in_opencv = true;
  ops.image = FisheyeImage;
  ops.direction = FisheyeDirection;
  ops.d_coefficients = DCoefficients;
  // 2 tan(theta / 2) = theta + theta^3 / 12 + ...
  ops.like_stereographic = [](double /*half_field_rad*/) { return std::vector<double>{1.0 / 12}; };
  return ops;
}

}  // namespace luxfit
