#include "calib/register/internal/bundle/reprojection_cost.h"
#include "tests/support/calib/office_camera.h"
#include "tests/support/test_rng.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

namespace luxfit {
namespace {

Camera DistortedCamera() { return OfficeCamera({-0.112, 0.061, 4e-4, -7e-4, 0.01, 0, 0, 0}); }

// Largest difference between `cost`'s derivatives and central differences along each tangent direction of
// `manifold`, over all parameters in `state`. Ceres' own checker steps off the unit sphere of quaternions,
// where its extrapolation loses up to two digits of the rotation's derivative.
double DerivativeError(const ceres::CostFunction& cost, const ceres::Manifold& manifold,
                       const Eigen::VectorXd& state) {
  const auto evaluate = [&cost](const Eigen::VectorXd& x, std::vector<Eigen::MatrixXd>* derivatives) {
    std::vector<const double*> parameters;
    std::vector<std::vector<double>> buffers;
    std::vector<double*> jacobians;
    Eigen::Index at = 0;
    const int rows = cost.num_residuals();
    for (const int size : cost.parameter_block_sizes()) {
      parameters.push_back(x.data() + at);
      buffers.emplace_back(static_cast<std::size_t>(rows) * static_cast<std::size_t>(size));
      at += size;
    }
    for (std::vector<double>& buffer : buffers) jacobians.push_back(buffer.data());
    Eigen::VectorXd residual(rows);
    EXPECT_TRUE(cost.Evaluate(parameters.data(), residual.data(), derivatives ? jacobians.data() : nullptr));
    if (derivatives == nullptr) return residual;
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      derivatives->push_back(
          Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
              buffers[i].data(), rows, cost.parameter_block_sizes()[i]));
    }
    return residual;
  };
  std::vector<Eigen::MatrixXd> derivatives;
  evaluate(state, &derivatives);
  Eigen::MatrixXd ambient(cost.num_residuals(), state.size());
  Eigen::Index at = 0;
  for (const Eigen::MatrixXd& d : derivatives) {
    ambient.middleCols(at, d.cols()) = d;
    at += d.cols();
  }
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> plus(state.size(),
                                                                              manifold.TangentSize());
  manifold.PlusJacobian(state.data(), plus.data());
  const Eigen::MatrixXd tangent = ambient * plus;
  double worst = 0;
  for (int k = 0; k < manifold.TangentSize(); ++k) {
    constexpr double kStep = 1e-5;
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(manifold.TangentSize(), k), back = -step;
    Eigen::VectorXd ahead(state.size()), behind(state.size());
    manifold.Plus(state.data(), step.data(), ahead.data());
    manifold.Plus(state.data(), back.data(), behind.data());
    const Eigen::VectorXd difference = (evaluate(ahead, nullptr) - evaluate(behind, nullptr)) / (2 * kStep);
    worst = std::max(worst, (difference - tangent.col(k)).norm());
  }
  return worst;
}

struct RandomSight {
  explicit RandomSight(std::mt19937_64& rng) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto vector = [&] { return Eigen::Vector3d(uniform(rng), uniform(rng), uniform(rng)); };
    world_from_cam = Eigen::AngleAxisd(3 * uniform(rng), vector().normalized());
    center = vector();
    p_in_world =
        world_from_cam * Eigen::Vector3d(uniform(rng), 0.7 * uniform(rng), 3 + uniform(rng)) + center;
    turn = Eigen::AngleAxisd(0.2 * uniform(rng), vector().normalized());
    offset = 0.1 * vector();
    size_error = 0.02 * uniform(rng);
  }
  Eigen::Quaterniond world_from_cam, turn;
  Eigen::Vector3d center, p_in_world, offset;
  double size_error = 0;
};

// Derivatives are about 5000 per unit: 1e-7 of that, from step^2 times the third derivative.
constexpr double kDerivativeTolerance = 5e-4;

TEST(TagCornerCostTest, DerivativesMatchCentralDifferencesOnTheManifold) {
  std::mt19937_64 rng = support::TestRng();
  const ceres::ProductManifold<PoseManifold, ceres::EuclideanManifold<3>, ceres::EigenQuaternionManifold,
                               ceres::EuclideanManifold<1>>
      manifold;
  const Camera camera = DistortedCamera();
  for (int i = 0; i < 30; ++i) {
    const RandomSight sight(rng);
    const TagCornerCost cost(camera, sight.p_in_world, sight.p_in_world + sight.offset, {{400, 300}, 0.3});
    Eigen::VectorXd state(15);
    state << sight.world_from_cam.coeffs(), sight.center, 0.1 * sight.offset, sight.turn.coeffs(),
        sight.size_error;
    EXPECT_LT(DerivativeError(cost, manifold, state), kDerivativeTolerance);
  }
}

TEST(PointCostTest, DerivativesMatchCentralDifferencesOnTheManifold) {
  std::mt19937_64 rng = support::TestRng();
  const ceres::ProductManifold<ceres::EuclideanManifold<3>, PoseManifold> manifold;
  const Camera camera = DistortedCamera();
  for (int i = 0; i < 30; ++i) {
    const RandomSight sight(rng);
    Eigen::VectorXd state(10);
    state << sight.p_in_world, sight.world_from_cam.coeffs(), sight.center;
    EXPECT_LT(DerivativeError(PointCost(camera, {{400, 300}, 0.3}), manifold, state), kDerivativeTolerance);
  }
}

TEST(SurfaceCostTest, CountsTheDistanceInSigmas) {
  const SurfaceCost cost({0, 0, 1}, {5, 5, 2}, 0.1);
  const ceres::EuclideanManifold<3> manifold;
  const Eigen::Vector3d p(1, 7, 2.3);
  const double* const parameters[] = {p.data()};
  double residual = 0;
  ASSERT_TRUE(cost.Evaluate(parameters, &residual, nullptr));
  EXPECT_NEAR(residual, 3, 1e-12);
  EXPECT_LT(DerivativeError(cost, manifold, p), 1e-6);
}

TEST(TagCornerCostTest, VanishesAtTheTruthAndCountsInSigmas) {
  const Camera camera = DistortedCamera();
  const Eigen::Matrix<double, 7, 1> pose = Eigen::Matrix<double, 7, 1>::Unit(3);
  const Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  const Eigen::Vector4d turn = Eigen::Vector4d::Unit(3);
  const double size_error = 0;
  const Eigen::Vector3d corner(0.3, -0.2, 2);
  const double* const parameters[] = {pose.data(), displacement.data(), turn.data(), &size_error};
  const TagCornerCost cost(camera, corner, corner,
                           {Project(camera, corner) - Eigen::Vector2d(0.5, -0.2), 0.1});
  Eigen::Vector2d residual;
  ASSERT_TRUE(cost.Evaluate(parameters, residual.data(), nullptr));
  EXPECT_NEAR(residual.x(), 5, 1e-9);
  EXPECT_NEAR(residual.y(), -2, 1e-9);
}

TEST(PointCostTest, RefusesPointsBehindTheCamera) {
  const Camera camera = DistortedCamera();
  Eigen::Matrix<double, 7, 1> pose = Eigen::Matrix<double, 7, 1>::Unit(3);
  pose[6] = 5;
  const Eigen::Vector3d point(0, 0, 2);
  const double* const parameters[] = {point.data(), pose.data()};
  Eigen::Vector2d residual;
  EXPECT_FALSE(PointCost(camera, {{0, 0}, 0.1}).Evaluate(parameters, residual.data(), nullptr));
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

TEST(ZeroPriorTest, CountsEachDirectionInItsOwnSigma) {
  Eigen::Matrix3d whitening;
  whitening << 1000, 20, 0, -30, 100, 5, 0, 0, 50;
  const ZeroPrior<3> prior(whitening);
  const Eigen::Vector3d displacement(0.001, -0.003, 0.002);
  const double* const parameters[] = {displacement.data()};
  Eigen::Vector3d residual;
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> jacobian;
  double* jacobians[] = {jacobian.data()};
  ASSERT_TRUE(prior.Evaluate(parameters, residual.data(), jacobians));
  EXPECT_TRUE(residual.isApprox(Eigen::Vector3d(0.94, -0.32, 0.1)));
  EXPECT_TRUE(jacobian.isApprox(whitening));
}

}  // namespace
}  // namespace luxfit
