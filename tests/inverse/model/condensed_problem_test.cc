#include "inverse/model/internal/condensed_problem.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <limits>
#include <random>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

NormalEquations EquationsOf(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual) {
  NormalEquations equations(jacobian.cols());
  equations.matrix = jacobian.transpose() * jacobian;
  equations.gradient = jacobian.transpose() * residual;
  equations.squares = residual.squaredNorm();
  return equations;
}

CondensedProblem Unbounded(Eigen::Index unknowns) {
  CondensedProblem problem;
  problem.upper = Eigen::VectorXd::Constant(unknowns, kInfinity);
  problem.lower = -problem.upper;
  return problem;
}

// A damped step ends short of the solution; an undamped one is at it but for rounding.
TEST(CondensedProblem, OneNearStepSolvesLinearRows) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  Eigen::MatrixXd jacobian(200, 4);
  Eigen::VectorXd data(200);
  for (double& x : jacobian.reshaped()) x = normal(rng);
  for (double& x : data) x = normal(rng);
  jacobian.col(2) *= 1e4;  // units differ
  CondensedProblem problem = Unbounded(4);
  problem.equations = [&](const Eigen::VectorXd& x) { return EquationsOf(jacobian, jacobian * x - data); };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
  InnerSolveOptions options;
  options.is_near = true;
  SolveCondensed(problem, options, x);
  const Eigen::VectorXd expected = jacobian.colPivHouseholderQr().solve(data);
  EXPECT_LT((x - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-6);
}

// Rosenbrock's function has its minimum at (1, 1), at the end of a bent valley.
TEST(CondensedProblem, FollowsABentValley) {
  CondensedProblem problem = Unbounded(2);
  problem.equations = [](const Eigen::VectorXd& x) {
    Eigen::Matrix2d jacobian;
    jacobian << -20 * x[0], 10, -1, 0;
    return EquationsOf(jacobian, Eigen::Vector2d(10 * (x[1] - x[0] * x[0]), 1 - x[0]));
  };
  Eigen::VectorXd x = Eigen::Vector2d(-1.2, 1);
  InnerSolveOptions options;
  options.max_iterations = 100;
  SolveCondensed(problem, options, x);
  EXPECT_LT((x - Eigen::Vector2d::Ones()).norm(), 1e-4);
}

TEST(CondensedProblem, StaysWithinBoundsAndWhereTheModelIsDefined) {
  CondensedProblem problem = Unbounded(1);
  problem.equations = [](const Eigen::VectorXd& x) {
    return EquationsOf(Eigen::MatrixXd::Ones(1, 1), x - Eigen::VectorXd::Constant(1, 5));
  };
  problem.upper[0] = 2;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(1);
  SolveCondensed(problem, {}, x);
  EXPECT_EQ(x[0], 2);
  problem.upper[0] = kInfinity;
  problem.equations = [](const Eigen::VectorXd& at) -> std::optional<NormalEquations> {
    if (at[0] > 1) return std::nullopt;
    return EquationsOf(Eigen::MatrixXd::Ones(1, 1), at - Eigen::VectorXd::Constant(1, 5));
  };
  x.setZero();
  SolveCondensed(problem, {}, x);
  EXPECT_GT(x[0], 0);
  EXPECT_LE(x[0], 1);
}

// The derivatives' sign is wrong, so that no step lowers the squares, damped or not. Damped ones are tried only where the
// first one promised something.
TEST(CondensedProblem, ARejectedStepThatPromisedLittleEndsTheSolve) {
  int asked = 0;
  CondensedProblem problem = Unbounded(1);
  problem.equations = [&](const Eigen::VectorXd& x) {
    ++asked;
    return EquationsOf(-Eigen::MatrixXd::Ones(1, 1), x - Eigen::VectorXd::Constant(1, 0.1));
  };
  InnerSolveOptions options;
  options.is_near = true;
  const auto evaluations = [&](double negligible_decrease) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(1);
    asked = 0;
    options.negligible_decrease = negligible_decrease;
    SolveCondensed(problem, options, x);
    EXPECT_EQ(x[0], 0);
    return asked;
  };
  EXPECT_EQ(evaluations(0.02), 2) << "the start and one step, which promised 0.01";
  EXPECT_GT(evaluations(0.005), 4);
}

// The rows say nothing of the difference of two unknowns: it stays as it starts.
TEST(CondensedProblem, LeavesWhatNothingDetermines) {
  CondensedProblem problem = Unbounded(2);
  problem.equations = [](const Eigen::VectorXd& x) {
    return EquationsOf(Eigen::MatrixXd::Ones(1, 2), Eigen::VectorXd::Constant(1, x.sum() - 3));
  };
  Eigen::VectorXd x = Eigen::Vector2d(1, 0);
  InnerSolveOptions options;
  options.is_near = true;
  SolveCondensed(problem, options, x);
  EXPECT_NEAR(x.sum(), 3, 1e-6);
  EXPECT_NEAR(x[0] - x[1], 1, 1e-6);
  Eigen::VectorXd none(0);
  SolveCondensed(problem, options, none);
}

}  // namespace
}  // namespace luxfit
