// Costs of the bundle adjustment, with analytic derivatives.
//
//   p_in_cam = R(q)^T (m + d + (1 + e) (p - m) - c),   r = (Project(p_in_cam) - corner_px) / sigma_px
//
// q: world_from_cam rotation, Eigen's coefficient order x y z w, on Ceres' EigenQuaternionManifold; c: camera
// centre in world (m); p, m: corner and centre of the surveyed tag; d: displacement of the tag in world (m);
// e: relative error of the printed size, one for all tags. World coordinates throughout, so that the
// covariance of (q, c) is that of the camera centre without further algebra. The manifold's tangent is *half*
// a rotation vector in world axes.
//
// A corner that is not in front of the camera has no projection: Evaluate fails and the solver shortens its
// step.
#ifndef LUXFIT_CALIB_INTERNAL_REPROJECTION_COST_H_
#define LUXFIT_CALIB_INTERNAL_REPROJECTION_COST_H_

#include <ceres/sized_cost_function.h>

#include <Eigen/Core>

#include "calib/camera.h"

namespace luxfit {

// Parameters: q (4), c (3), d (3), e (1); two residuals.
class ReprojectionCost : public ceres::SizedCostFunction<2, 4, 3, 3, 1> {
 public:
  ReprojectionCost(const Camera& camera, const Eigen::Vector3d& corner_in_world,
                   const Eigen::Vector3d& center_in_world, const Eigen::Vector2d& corner_px, double sigma_px);
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  Camera camera_;
  Eigen::Vector3d corner_in_world_, center_in_world_;
  Eigen::Vector2d corner_px_;
  double sigma_px_;
};

// r = x / sigma: the survey's own uncertainty, x of n components with mean 0 (d in m, n = 3; e, n = 1).
template <int n>
class ZeroPrior : public ceres::SizedCostFunction<n, n> {
 public:
  explicit ZeroPrior(double sigma) : sigma_(sigma) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    for (int i = 0; i < n; ++i) residuals[i] = parameters[0][i] / sigma_;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    for (int i = 0; i < n * n; ++i) jacobians[0][i] = i % (n + 1) == 0 ? 1 / sigma_ : 0;
    return true;
  }

 private:
  double sigma_;
};

}  // namespace luxfit

#endif  // LUXFIT_CALIB_INTERNAL_REPROJECTION_COST_H_
