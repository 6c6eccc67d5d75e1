#include "calib/internal/reprojection_cost.h"
#include "tests/support/office_camera.h"
#include "tests/support/test_rng.h"

#include <ceres/manifold.h>
#include <ceres/product_manifold.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace luxfit {
namespace {

Camera DistortedCamera() { return OfficeCamera({-0.112, 0.061, 4e-4, -7e-4, 0.01, 0, 0, 0}); }

// Central differences along each tangent direction. Ceres' own checker steps off the unit sphere of
// quaternions, where its extrapolation loses up to two digits of the rotation's derivative.
TEST(ReprojectionCostTest, DerivativesMatchCentralDifferencesOnTheManifold) {
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> uniform(-1, 1);
  const ceres::ProductManifold<ceres::EigenQuaternionManifold, ceres::EuclideanManifold<7>> manifold;
  using State = Eigen::Matrix<double, 11, 1>;  // q, c, d, e
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector3d axis = Eigen::Vector3d(uniform(rng), uniform(rng), uniform(rng)).normalized();
    const Eigen::Quaterniond world_from_cam(Eigen::AngleAxisd(3 * uniform(rng), axis));
    const Eigen::Vector3d center(uniform(rng), uniform(rng), uniform(rng));
    const Eigen::Vector3d p_in_cam(uniform(rng), 0.7 * uniform(rng), 3 + uniform(rng));
    const Eigen::Vector3d corner = world_from_cam * p_in_cam + center;
    const Eigen::Vector3d middle = corner + 0.1 * Eigen::Vector3d(uniform(rng), uniform(rng), uniform(rng));
    const ReprojectionCost cost(DistortedCamera(), corner, middle, {400, 300}, 0.3);
    State state;
    state << world_from_cam.coeffs(), center,
        0.01 * Eigen::Vector3d(uniform(rng), uniform(rng), uniform(rng)), 0.02 * uniform(rng);
    const auto evaluate = [&cost](const State& x, double** jacobians) {
      const double* const parameters[] = {x.data(), x.data() + 4, x.data() + 7, x.data() + 10};
      Eigen::Vector2d residual;
      EXPECT_TRUE(cost.Evaluate(parameters, residual.data(), jacobians));
      return residual;
    };
    Eigen::Matrix<double, 2, 4, Eigen::RowMajor> d_q;
    Eigen::Matrix<double, 2, 3, Eigen::RowMajor> d_center, d_displacement;
    Eigen::Vector2d d_size;
    double* jacobians[] = {d_q.data(), d_center.data(), d_displacement.data(), d_size.data()};
    evaluate(state, jacobians);
    Eigen::Matrix<double, 2, 11> ambient;
    ambient << d_q, d_center, d_displacement, d_size;
    Eigen::Matrix<double, 11, 10, Eigen::RowMajor> plus;
    manifold.PlusJacobian(state.data(), plus.data());
    const Eigen::Matrix<double, 2, 10> tangent = ambient * plus;
    for (int k = 0; k < 10; ++k) {
      constexpr double kStep = 1e-5;
      const Eigen::Matrix<double, 10, 1> step = kStep * Eigen::Matrix<double, 10, 1>::Unit(k);
      const Eigen::Matrix<double, 10, 1> back = -step;
      State ahead, behind;
      manifold.Plus(state.data(), step.data(), ahead.data());
      manifold.Plus(state.data(), back.data(), behind.data());
      const Eigen::Vector2d difference = (evaluate(ahead, nullptr) - evaluate(behind, nullptr)) / (2 * kStep);
      // Derivatives are about 5000 per unit: 1e-7 of that, from step^2 times the third derivative.
      EXPECT_LT((difference - tangent.col(k)).norm(), 5e-4) << "tangent direction " << k;
    }
  }
}

TEST(ReprojectionCostTest, VanishesAtTheTruthAndCountsInSigmas) {
  const Camera camera = DistortedCamera();
  const Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  const Eigen::Vector3d center = Eigen::Vector3d::Zero(), displacement = Eigen::Vector3d::Zero();
  const double size_error = 0;
  const Eigen::Vector3d corner(0.3, -0.2, 2);
  const double* const parameters[] = {q.coeffs().data(), center.data(), displacement.data(), &size_error};
  const ReprojectionCost cost(camera, corner, corner, Project(camera, corner) - Eigen::Vector2d(0.5, -0.2),
                              0.1);
  Eigen::Vector2d residual;
  ASSERT_TRUE(cost.Evaluate(parameters, residual.data(), nullptr));
  EXPECT_NEAR(residual.x(), 5, 1e-9);
  EXPECT_NEAR(residual.y(), -2, 1e-9);
}

TEST(ReprojectionCostTest, RefusesCornersBehindTheCamera) {
  const Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  const Eigen::Vector3d center(0, 0, 5), displacement = Eigen::Vector3d::Zero();
  const double size_error = 0;
  const double* const parameters[] = {q.coeffs().data(), center.data(), displacement.data(), &size_error};
  const ReprojectionCost cost(DistortedCamera(), {0, 0, 2}, {0, 0, 2}, {0, 0}, 0.1);
  Eigen::Vector2d residual;
  EXPECT_FALSE(cost.Evaluate(parameters, residual.data(), nullptr));
}

TEST(ZeroPriorTest, CountsInSigmasAndIsLinear) {
  const ZeroPrior<3> prior(0.002);
  const Eigen::Vector3d displacement(0.001, -0.003, 0.002);
  const double* const parameters[] = {displacement.data()};
  Eigen::Vector3d residual;
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> jacobian;
  double* jacobians[] = {jacobian.data()};
  ASSERT_TRUE(prior.Evaluate(parameters, residual.data(), jacobians));
  EXPECT_TRUE(residual.isApprox(Eigen::Vector3d(0.5, -1.5, 1)));
  // Linear and zero at zero: the derivative times the argument is the value.
  EXPECT_TRUE((jacobian * displacement).isApprox(residual));
  EXPECT_TRUE(jacobian.isDiagonal());
  ASSERT_TRUE(prior.Evaluate(parameters, residual.data(), nullptr));
}

}  // namespace
}  // namespace luxfit
