#include "inverse/model/internal/condensed_problem.h"

#include <ceres/ceres.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace luxfit {
namespace {

// Holds as many rows as unknowns and one more that no unknown changes.
struct Condensate {
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd residual;
};

Condensate Condense(const NormalEquations& equations) {
  const Eigen::Index n = equations.gradient.size();
  const Eigen::VectorXd unit = equations.matrix.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const Eigen::VectorXd inverse = unit.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(inverse.asDiagonal() * equations.matrix *
                                                             inverse.asDiagonal());
  const double rounding = 1e-15 * std::max(eigen.eigenvalues().maxCoeff(), 1e-300);
  Condensate condensed{Eigen::MatrixXd::Zero(n + 1, n), Eigen::VectorXd::Zero(n + 1)};
  for (Eigen::Index d = 0; d < n; ++d) {
    const double value = eigen.eigenvalues()[d];
    if (value <= rounding) continue;  // the rows do not determine this direction
    const auto direction = eigen.eigenvectors().col(d);
    condensed.jacobian.row(d) = std::sqrt(value) * direction.cwiseProduct(unit).transpose();
    condensed.residual[d] = direction.cwiseProduct(inverse).dot(equations.gradient) / std::sqrt(value);
  }
  const double left = equations.squares - condensed.residual.squaredNorm();
  condensed.residual[n] = std::sqrt(std::max(left, 0.0));
  return condensed;
}

class CondensedCost : public ceres::CostFunction {
 public:
  CondensedCost(const CondensedProblem& problem, int unknowns) : problem_(problem) {
    set_num_residuals(unknowns + 1);
    mutable_parameter_block_sizes()->push_back(unknowns);
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const Eigen::Index n = num_residuals() - 1;
    const Eigen::Map<const Eigen::VectorXd> x(blocks[0], n);
    // Ceres asks for a step's cost first and, where that is good (it nearly always is), for its Jacobian.
    if (known_at_.size() != n || known_at_ != x) {
      const std::optional<NormalEquations> equations = problem_.equations(x);
      if (!equations) return false;
      known_ = Condense(*equations);
      known_at_ = x;
    }
    Eigen::Map<Eigen::VectorXd>(residuals, n + 1) = known_.residual;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      Eigen::Map<RowMajor>(jacobians[0], n + 1, n) = known_.jacobian;
    }
    return true;
  }

 private:
  const CondensedProblem& problem_;
  mutable Eigen::VectorXd known_at_;
  mutable Condensate known_;
};

class StopAfterAcceptedStep : public ceres::IterationCallback {
 public:
  explicit StopAfterAcceptedStep(double negligible_decrease) : negligible_cost_(negligible_decrease / 2) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.iteration == 0) return ceres::SOLVER_CONTINUE;
    const double promised = summary.cost_change / summary.relative_decrease;
    return summary.step_is_successful || promised < negligible_cost_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                                                     : ceres::SOLVER_CONTINUE;
  }

 private:
  double negligible_cost_;
};

}  // namespace

double SolveCondensed(const CondensedProblem& problem, const InnerSolveOptions& options, Eigen::VectorXd& x) {
  if (x.size() == 0)
    return options.near_radius;  // everything is given: nothing to solve, and Ceres aborts on an empty block
  const auto unknowns = static_cast<int>(x.size());
  ceres::Problem ceres_problem;
  ceres_problem.AddResidualBlock(new CondensedCost(problem, unknowns), nullptr, x.data());
  for (int i = 0; i < unknowns; ++i) {
    ceres_problem.SetParameterLowerBound(x.data(), i, problem.lower[i]);
    ceres_problem.SetParameterUpperBound(x.data(), i, problem.upper[i]);
  }
  StopAfterAcceptedStep stop(options.negligible_decrease);
  ceres::Solver::Options ceres_options;
  ceres_options.linear_solver_type = ceres::DENSE_QR;
  ceres_options.max_num_iterations = options.max_iterations;
  // Light is summed in single precision: smaller changes of the cost are rounding.
  ceres_options.function_tolerance = options.is_near ? 1e-6 : 1e-5;
  ceres_options.parameter_tolerance = 1e-7;
  ceres_options.initial_trust_region_radius = options.is_near ? options.near_radius : 10;
  if (options.is_near) {
    ceres_options.update_state_every_iteration = false;
    ceres_options.callbacks.push_back(&stop);
  }
  // Bounds are seldom met: a line search along every step to them costs a third of the time and finds
  // nothing.
  ceres_options.max_num_line_search_step_size_iterations = 0;
  ceres_options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(ceres_options, &ceres_problem, &summary);
  return summary.iterations.empty() ? options.near_radius : summary.iterations.back().trust_region_radius;
}

}  // namespace luxfit
