#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "calib/lens/internal/lens.h"
#include "calib/lens/internal/mrcal_lens.h"

namespace luxfit {
namespace {

// Returns the lens alone: focal lengths 1, centre 0.
MrcalLens UnitLens(const Camera& camera) {
  MrcalLens lens = ToMrcal(camera);
  lens.intrinsics[0] = lens.intrinsics[1] = 1;
  lens.intrinsics[2] = lens.intrinsics[3] = 0;
  return lens;
}

LensImage ImageBy(const MrcalLens& lens, const Eigen::Vector3d& p_in_cam) {
  LensImage out;
  out.xy.setConstant(kNoImage);
  out.d_point.setConstant(kNoImage);
  // The stereographic projection lacks an image of one direction only: the axis behind the camera.
  if (!p_in_cam.allFinite() || !(p_in_cam.norm() + p_in_cam.z() > 1e-9 * p_in_cam.norm())) return out;
  const auto projection = ProjectByMrcal(lens.model, lens.intrinsics.data(), p_in_cam, nullptr);
  return projection ? LensImage{projection->pixel, projection->d_pixel_d_point} : out;
}

LensImage SplinedImage(const Camera& camera, const Eigen::Vector3d& p_in_cam) {
  return ImageBy(UnitLens(camera), p_in_cam);
}

Eigen::Vector3d SplinedDirection(const Camera& camera, const Eigen::Vector2d& xy) {
  const MrcalLens lens = UnitLens(camera);  // once: it copies all control points
  // Newton's method on the unit sphere starts from the plain stereographic lens: tan(theta / 2) = |xy| / 2.
  const double s = xy.squaredNorm() / 4;
  Eigen::Vector3d v = Eigen::Vector3d(xy.x(), xy.y(), 1 - s) / (1 + s);
  constexpr int kMaxIterations = 30;
  constexpr double kTolerance = 1e-12;
  for (int i = 0; i < kMaxIterations; ++i) {
    const LensImage image = ImageBy(lens, v);
    if (!image.xy.allFinite()) break;
    const Eigen::Vector2d residual = image.xy - xy;
    if (residual.norm() < kTolerance) return v;
    Eigen::Matrix<double, 3, 2> tangent;
    tangent.col(0) = v.unitOrthogonal();
    tangent.col(1) = v.cross(tangent.col(0));
    const Eigen::Matrix2d jacobian = image.d_point * tangent;
    if (!(std::abs(jacobian.determinant()) > 1e-9)) break;
    v = (v - tangent * (jacobian.inverse() * residual)).normalized();
  }
  return Eigen::Vector3d::Constant(kNoImage);
}

}  // namespace

LensOps SplinedLens() {
  constexpr int kMostKnots = 64;  // one control point each half degree of a usual lens
  LensOps ops;
  ops.lens = LensModel::kSplined;
  ops.key = "splined";
  ops.size = &LensKind::knots;
  ops.has_size = [](int size) { return size == 0 || (size >= 4 && size <= kMostKnots); };
  ops.tried_sizes = {8, 14};
  ops.has_control_points = true;
  ops.is_in_mrcal = true;
  ops.image = SplinedImage;
  ops.direction = SplinedDirection;
  return ops;
}

}  // namespace luxfit
