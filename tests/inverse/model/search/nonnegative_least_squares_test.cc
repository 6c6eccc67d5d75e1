#include "inverse/model/internal/search/nonnegative_least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>
#include <stdexcept>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

Eigen::VectorXd Solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return SolveNonNegative(a.transpose() * a, a.transpose() * b);
}

TEST(SolveNonNegative, IsLeastSquaresWhereThatIsPositive) {
  Eigen::MatrixXd a(3, 2);
  a << 1, 0, 0, 1, 1, 1;
  EXPECT_TRUE(Solve(a, Eigen::Vector3d(1, 2, 3)).isApprox(Eigen::Vector2d(1, 2), 1e-9));
}

// Lawson and Hanson's own conditions: what is positive has no gradient, what is zero would rather shrink.
TEST(SolveNonNegative, MeetsTheKuhnTuckerConditions) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  int zeros = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(30, 12, [&] { return normal(rng); });
    const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(30, [&] { return normal(rng); });
    const Eigen::VectorXd x = Solve(a, b);
    const Eigen::VectorXd gradient = a.transpose() * (a * x - b);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      EXPECT_GE(x[i], 0);
      if (x[i] > 0) {
        EXPECT_NEAR(gradient[i], 0, 1e-8);
      } else {
        EXPECT_GE(gradient[i], -1e-8);
        ++zeros;
      }
    }
  }
  EXPECT_GT(zeros, 100);  // the constraint was at work
}

TEST(SolveNonNegative, EndsWhereColumnsAreTwinsOrEmpty) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Ones(5, 3);
  a.col(2).setZero();
  const Eigen::VectorXd x = Solve(a, Eigen::VectorXd::Constant(5, 4));
  EXPECT_NEAR(x[0] + x[1], 4, 1e-6);
  EXPECT_EQ(x[2], 0);
  EXPECT_TRUE(Solve(a, Eigen::VectorXd::Constant(5, -4)).isZero());
  EXPECT_EQ(SolveNonNegative(Eigen::MatrixXd(0, 0), Eigen::VectorXd(0)).size(), 0);
  EXPECT_THROW(SolveNonNegative(a, Eigen::VectorXd(3)), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
