#include "inverse/model/internal/frozen_problem.h"

#include <ceres/ceres.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "inverse/model/internal/light_model.h"

namespace luxfit {
namespace {

// Sums the rows in an order that does not depend on the threads, so that every run gives the same sums. Of
// the matrix, only the lower triangle is filled.
NormalEquations SumRows(const Prediction& prediction, const Eigen::VectorXd& residual,
                        const Eigen::VectorXd& root_weight) {
  constexpr Eigen::Index kGrain = 1024;
  using Range = tbb::blocked_range<Eigen::Index>;
  return tbb::parallel_deterministic_reduce(
      Range(0, residual.size(), kGrain), NormalEquations(prediction.jacobian.cols()),
      [&](const Range& range, NormalEquations sum) {
        const Eigen::Index count = range.end() - range.begin();
        const Eigen::MatrixXd rows = (root_weight.segment(range.begin(), count).asDiagonal() *
                                      prediction.jacobian.middleRows(range.begin(), count))
                                         .transpose();
        sum.matrix.selfadjointView<Eigen::Lower>().rankUpdate(rows);
        sum.gradient.noalias() += rows * residual.segment(range.begin(), count);
        sum.squares += residual.segment(range.begin(), count).squaredNorm();
        return sum;
      },
      [](NormalEquations a, const NormalEquations& b) {
        a.Add(b);
        return a;
      });
}

// Holds as many rows as parameters and one more that no parameter changes.
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

class FrozenCost : public ceres::CostFunction {
 public:
  FrozenCost(const FrozenProblem& problem, const Eigen::VectorXd& start)
      : problem_(problem), known_at_(start), known_(CondensateOf(problem.at_base, start)) {
    const auto n = static_cast<int>(start.size());
    set_num_residuals(n + 1);
    mutable_parameter_block_sizes()->push_back(n);
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const auto n = static_cast<Eigen::Index>(problem_.parameters.size());
    const Eigen::Map<const Eigen::VectorXd> x(blocks[0], n);
    // Ceres asks for a step's cost first and, where that is good (it nearly always is), for its Jacobian.
    if (known_at_ != x) {
      const Prediction prediction = problem_.model.Predict(
          WithParameters(problem_.base, problem_.parameters, x), problem_.parameters, true);
      if (!prediction.value.allFinite()) return false;
      known_ = CondensateOf(prediction, x);
      known_at_ = x;
    }
    Eigen::Map<Eigen::VectorXd>(residuals, n + 1) = known_.residual;
    if (jacobians != nullptr && jacobians[0] != nullptr)
      Eigen::Map<RowMajorMatrix>(jacobians[0], n + 1, n) = known_.jacobian;
    return true;
  }

 private:
  Condensate CondensateOf(const Prediction& prediction, const Eigen::VectorXd& x) const {
    const Eigen::VectorXd residual = (prediction.value - problem_.data).cwiseProduct(problem_.root_weight);
    NormalEquations equations = SumRows(prediction, residual, problem_.root_weight);
    equations.matrix = Eigen::MatrixXd(equations.matrix.selfadjointView<Eigen::Lower>());
    equations.Add(problem_.priors, problem_.smoothness, x);
    return Condense(equations);
  }

  const FrozenProblem& problem_;
  mutable Eigen::VectorXd known_at_;
  mutable Condensate known_;
};

class StopAfterAcceptedStep : public ceres::IterationCallback {
 public:
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    return summary.iteration > 0 && summary.step_is_successful ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                                               : ceres::SOLVER_CONTINUE;
  }
};

}  // namespace

IndexedPriors PriorsOf(const std::vector<Parameter>& parameters, const std::vector<ParameterPrior>& priors) {
  IndexedPriors indexed;
  for (const ParameterPrior& prior : priors) {
    for (size_t i = 0; i < parameters.size(); ++i) {
      if (parameters[i].Is(prior.kind, prior.index, prior.quantity))
        indexed.emplace_back(static_cast<int>(i), prior);
    }
  }
  return indexed;
}

void NormalEquations::Add(const IndexedPriors& priors, const std::vector<SmoothnessRow>& smoothness,
                          const Eigen::VectorXd& x) {
  for (const auto& [parameter, prior] : priors) {
    const double z = (x[parameter] - prior.mean) / prior.sigma;
    matrix(parameter, parameter) += 1 / (prior.sigma * prior.sigma);
    gradient[parameter] += z / prior.sigma;
    squares += z * z;
  }
  AddSmoothness(smoothness, matrix);
  for (const SmoothnessRow& row : smoothness) {
    const double value = row.Value(x);
    for (const auto& [parameter, coefficient] : row.terms) gradient[parameter] += coefficient * value;
    squares += value * value;
  }
}

void SolveFrozen(const FrozenProblem& problem, const InnerSolveOptions& options, Eigen::VectorXd& x) {
  if (x.size() == 0) return;  // everything is given: nothing to solve, and Ceres aborts on an empty block
  ceres::Problem ceres_problem;
  ceres_problem.AddResidualBlock(new FrozenCost(problem, x), nullptr, x.data());
  for (size_t i = 0; i < problem.parameters.size(); ++i) {
    ceres_problem.SetParameterLowerBound(x.data(), static_cast<int>(i), problem.parameters[i].lower);
    ceres_problem.SetParameterUpperBound(x.data(), static_cast<int>(i), problem.parameters[i].upper);
  }
  StopAfterAcceptedStep stop;
  ceres::Solver::Options ceres_options;
  ceres_options.linear_solver_type = ceres::DENSE_QR;
  ceres_options.max_num_iterations = options.max_iterations;
  // Light is summed in single precision: smaller changes of the cost are rounding.
  ceres_options.function_tolerance = options.is_near ? 1e-6 : 1e-5;
  ceres_options.parameter_tolerance = 1e-7;
  ceres_options.initial_trust_region_radius = options.is_near ? 1e8 : 10;
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
}

}  // namespace luxfit
