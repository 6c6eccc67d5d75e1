#include "calib/internal/reprojection_cost.h"

#include <Eigen/Geometry>

namespace luxfit {

ReprojectionCost::ReprojectionCost(const Camera& camera, const Eigen::Vector3d& corner_in_world,
                                   const Eigen::Vector3d& center_in_world, const Eigen::Vector2d& corner_px,
                                   double sigma_px)
    : camera_(camera),
      corner_in_world_(corner_in_world),
      center_in_world_(center_in_world),
      corner_px_(corner_px),
      sigma_px_(sigma_px) {}

bool ReprojectionCost::Evaluate(double const* const* parameters, double* residuals,
                                double** jacobians) const {
  using RowMajor23 = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;
  using RowMajor24 = Eigen::Matrix<double, 2, 4, Eigen::RowMajor>;
  const Eigen::Map<const Eigen::Quaterniond> world_from_cam(parameters[0]);
  const Eigen::Map<const Eigen::Vector3d> center(parameters[1]);
  const Eigen::Map<const Eigen::Vector3d> displacement(parameters[2]);
  const double size_error = parameters[3][0];
  const Eigen::Vector3d arm = corner_in_world_ - center_in_world_;

  const Eigen::Matrix3d cam_from_world = world_from_cam.toRotationMatrix().transpose();
  const Eigen::Vector3d from_center = corner_in_world_ + displacement + size_error * arm - center;
  const Projection projection = ProjectWithJacobian(camera_, cam_from_world * from_center);
  if (!projection.pixel.allFinite()) return false;
  Eigen::Map<Eigen::Vector2d>(residuals, 2) = (projection.pixel - corner_px_) / sigma_px_;
  if (jacobians == nullptr) return true;

  const Eigen::Matrix<double, 2, 3> d_point = projection.d_pixel_d_point * cam_from_world / sigma_px_;
  if (jacobians[0] != nullptr) {
    // exp(w) on the left of R: d p_in_cam = R^T [from_center]x dw, w = 2 delta with delta the manifold's
    // tangent.
    Eigen::Matrix3d cross;
    cross << 0, -from_center.z(), from_center.y(), from_center.z(), 0, -from_center.x(), -from_center.y(),
        from_center.x(), 0;
    // d q / d delta = (delta, 0) * q; its columns are orthonormal, so its transpose carries the derivative to
    // q.
    const Eigen::Vector4d& q = world_from_cam.coeffs();
    Eigen::Matrix<double, 4, 3> d_q;
    d_q << q.w(), q.z(), -q.y(), -q.z(), q.w(), q.x(), q.y(), -q.x(), q.w(), -q.x(), -q.y(), -q.z();
    Eigen::Map<RowMajor24>(jacobians[0], 2, 4) = 2 * d_point * cross * d_q.transpose();
  }
  if (jacobians[1] != nullptr) Eigen::Map<RowMajor23>(jacobians[1], 2, 3) = -d_point;
  if (jacobians[2] != nullptr) Eigen::Map<RowMajor23>(jacobians[2], 2, 3) = d_point;
  if (jacobians[3] != nullptr) Eigen::Map<Eigen::Vector2d>(jacobians[3], 2) = d_point * arm;
  return true;
}

}  // namespace luxfit
