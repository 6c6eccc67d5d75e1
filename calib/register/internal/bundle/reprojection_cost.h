// Defines the costs of the bundle adjustment, with analytic derivatives.
//
//   p_in_cam = R(q)^T (p_in_world - c),   r = (Project(p_in_cam) - pixel) / sigma_px
//   corner of a tag:  p_in_world = m + d + (1 + e) R(t) a
//   free point:       p_in_world itself
//
// (q, c): pose of the view: world_from_cam rotation, Eigen's coefficient order x y z w, then the camera
// centre in world (m); seven numbers on PoseManifold. m: surveyed centre of the tag, a: the corner from
// there, world axes. d: displacement of the tag (m). t: its turn, a quaternion as q. e: relative error of the
// printed size, one for all tags. World coordinates throughout, so that the covariance of (q, c) is that of
// the camera centre without further algebra. The manifold's tangent is *half* a rotation vector in world
// axes.
//
// A point that is not in front of the camera has no projection: Evaluate fails and the solver shortens its
// step. Cameras are referred to, not copied: they must outlive the problem.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_REPROJECTION_COST_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_REPROJECTION_COST_H_

#include <ceres/manifold.h>
#include <ceres/product_manifold.h>
#include <ceres/sized_cost_function.h>

#include <Eigen/Core>

#include "calib/lens/camera.h"

namespace luxfit {

using PoseManifold = ceres::ProductManifold<ceres::EigenQuaternionManifold, ceres::EuclideanManifold<3>>;

// Holds a pixel and its standard deviation per axis.
struct MeasuredPixel {
  Eigen::Vector2d pixel;
  double sigma_px = 1;
};

// Parameters: (q, c) (7), d (3), t (4), e (1); two residuals.
class TagCornerCost : public ceres::SizedCostFunction<2, 7, 3, 4, 1> {
 public:
  TagCornerCost(const Camera& camera, const Eigen::Vector3d& corner_in_world,
                const Eigen::Vector3d& center_in_world, const MeasuredPixel& measured);
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  const Camera* camera_;
  Eigen::Vector3d arm_, center_in_world_;
  MeasuredPixel measured_;
};

// Parameters: the point (3), (q, c) (7); two residuals.
class PointCost : public ceres::SizedCostFunction<2, 3, 7> {
 public:
  PointCost(const Camera& camera, const MeasuredPixel& measured) : camera_(&camera), measured_(measured) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  const Camera* camera_;
  MeasuredPixel measured_;
};

// r = n . (p - p0) / sigma: a point on a surface through p0 with unit normal n. Parameter: the point.
class SurfaceCost : public ceres::SizedCostFunction<1, 3> {
 public:
  SurfaceCost(const Eigen::Vector3d& normal, const Eigen::Vector3d& on_surface, double sigma_m)
      : normal_(normal), offset_m_(normal.dot(on_surface)), sigma_m_(sigma_m) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    residuals[0] = (normal_.dot(Eigen::Map<const Eigen::Vector3d>(parameters[0])) - offset_m_) / sigma_m_;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<Eigen::Vector3d>(jacobians[0], 3) = normal_ / sigma_m_;
    return true;
  }

 private:
  Eigen::Vector3d normal_;
  double offset_m_, sigma_m_;
};

// r = W x: the survey's own uncertainty, x of n components with mean 0 (d in m, n = 3; e, n = 1) and covariance
// (W^T W)^-1. W = I / sigma where all components are known equally well.
template <int n>
class ZeroPrior : public ceres::SizedCostFunction<n, n> {
 public:
  using Whitening = Eigen::Matrix<double, n, n>;

  explicit ZeroPrior(double sigma) : whitening_(Whitening::Identity() / sigma) {}
  explicit ZeroPrior(const Whitening& whitening) : whitening_(whitening) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    using Vector = Eigen::Matrix<double, n, 1>;
    Eigen::Map<Vector>(residuals, n) = whitening_ * Eigen::Map<const Vector>(parameters[0]);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    // Ceres stores Jacobians row by row.
    Eigen::Map<Whitening>(jacobians[0], n, n) = whitening_.transpose();
    return true;
  }

 private:
  Whitening whitening_;
};

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_REPROJECTION_COST_H_
