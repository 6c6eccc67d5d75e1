#include "calib/register/internal/bundle/reprojection_cost.h"

#include <Eigen/Geometry>

#include "calib/lens/internal/rotation_vector.h"

namespace luxfit {
namespace {

using RowMajor23 = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;
using RowMajor24 = Eigen::Matrix<double, 2, 4, Eigen::RowMajor>;
using RowMajor27 = Eigen::Matrix<double, 2, 7, Eigen::RowMajor>;

// Returns d(value)/d(q) from a derivative d_v by v, for v = R(q) v'. exp(w) on the left of R moves v by
// w x v = -[v]x w, w = 2 delta with delta the manifold's tangent. d q / d delta = (delta, 0) * q has
// orthonormal columns, so its transpose carries the derivative to q.
RowMajor24 ByRotation(const RowMajor23& d_v, const Eigen::Vector3d& v, const Eigen::Quaterniond& q) {
  Eigen::Matrix<double, 4, 3> d_q;
  d_q << q.w(), q.z(), -q.y(), -q.z(), q.w(), q.x(), q.y(), -q.x(), q.w(), -q.x(), -q.y(), -q.z();
  return -2 * d_v * CrossMatrix(v) * d_q.transpose();
}

// Sets the residual of a world point seen from a pose. Writes its derivative by the point to `d_point`, by
// the pose to `d_pose` where there is one. Returns false where the point has no image.
bool Residual(const Camera& camera, const MeasuredPixel& measured, const double* pose,
              const Eigen::Vector3d& p_in_world, double* residuals, RowMajor23& d_point, double* d_pose) {
  const Eigen::Map<const Eigen::Quaterniond> world_from_cam(pose);
  const Eigen::Map<const Eigen::Vector3d> center(pose + 4);
  const Eigen::Matrix3d cam_from_world = world_from_cam.toRotationMatrix().transpose();
  const Eigen::Vector3d from_center = p_in_world - center;
  const Projection projection = ProjectWithJacobian(camera, cam_from_world * from_center);
  if (!projection.pixel.allFinite()) return false;
  Eigen::Map<Eigen::Vector2d>(residuals, 2) = (projection.pixel - measured.pixel) / measured.sigma_px;
  d_point = projection.d_pixel_d_point * cam_from_world / measured.sigma_px;
  if (d_pose == nullptr) return true;
  // R^T undoes the turn: the derivative is minus that of R v.
  Eigen::Map<RowMajor27> d(d_pose, 2, 7);
  d.leftCols<4>() = -ByRotation(d_point, from_center, world_from_cam);
  d.rightCols<3>() = -d_point;
  return true;
}

}  // namespace

TagCornerCost::TagCornerCost(const Camera& camera, const Eigen::Vector3d& corner_in_world,
                             const Eigen::Vector3d& center_in_world, const MeasuredPixel& measured)
    : camera_(&camera),
      arm_(corner_in_world - center_in_world),
      center_in_world_(center_in_world),
      measured_(measured) {}

bool TagCornerCost::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  const Eigen::Map<const Eigen::Vector3d> displacement(parameters[1]);
  const Eigen::Quaterniond turn{Eigen::Map<const Eigen::Quaterniond>(parameters[2])};
  const double size_error = parameters[3][0];
  const Eigen::Vector3d arm = turn * arm_;
  RowMajor23 d_point;
  const Eigen::Vector3d corner = center_in_world_ + displacement + (1 + size_error) * arm;
  if (!Residual(*camera_, measured_, parameters[0], corner, residuals, d_point,
                jacobians == nullptr ? nullptr : jacobians[0])) {
    return false;
  }
  if (jacobians == nullptr) return true;
  if (jacobians[1] != nullptr) Eigen::Map<RowMajor23>(jacobians[1], 2, 3) = d_point;
  if (jacobians[2] != nullptr) {
    Eigen::Map<RowMajor24>(jacobians[2], 2, 4) = ByRotation(d_point, (1 + size_error) * arm, turn);
  }
  if (jacobians[3] != nullptr) Eigen::Map<Eigen::Vector2d>(jacobians[3], 2) = d_point * arm;
  return true;
}

bool PointCost::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  RowMajor23 d_point;
  if (!Residual(*camera_, measured_, parameters[1], Eigen::Map<const Eigen::Vector3d>(parameters[0]),
                residuals, d_point, jacobians == nullptr ? nullptr : jacobians[1])) {
    return false;
  }
  if (jacobians != nullptr && jacobians[0] != nullptr) Eigen::Map<RowMajor23>(jacobians[0], 2, 3) = d_point;
  return true;
}

}  // namespace luxfit
