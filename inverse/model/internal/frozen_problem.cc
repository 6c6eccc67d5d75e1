#include "inverse/model/internal/frozen_problem.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <optional>

#include "inverse/model/internal/light_model.h"

namespace luxfit {
namespace {

// Sums the rows in an order that does not depend on the threads, so that every run gives the same sums. Of
// the matrix, only the lower triangle is filled.
NormalEquations SumRows(const RowMajorMatrix& jacobian, const Eigen::VectorXd& residual) {
  constexpr Eigen::Index kGrain = 1024;
  using Range = tbb::blocked_range<Eigen::Index>;
  return tbb::parallel_deterministic_reduce(
      Range(0, residual.size(), kGrain), NormalEquations(jacobian.cols()),
      [&](const Range& range, NormalEquations sum) {
        const Eigen::Index count = range.end() - range.begin();
        const Eigen::MatrixXd rows = jacobian.middleRows(range.begin(), count).transpose();
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

NormalEquations EquationsOf(const FrozenProblem& problem, const Prediction& prediction,
                            const Eigen::VectorXd& x) {
  NormalEquations equations =
      SumRows(problem.weights.Weighed(prediction.jacobian), problem.weights.Residual(prediction.value));
  equations.matrix = Eigen::MatrixXd(equations.matrix.selfadjointView<Eigen::Lower>());
  AddPriors(problem.priors, problem.smoothness, x, equations);
  return equations;
}

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

void AddPriors(const IndexedPriors& priors, const std::vector<SmoothnessRow>& smoothness,
               const Eigen::VectorXd& x, NormalEquations& equations) {
  for (const auto& [parameter, prior] : priors) {
    const double z = (x[parameter] - prior.mean) / prior.sigma;
    equations.matrix(parameter, parameter) += 1 / (prior.sigma * prior.sigma);
    equations.gradient[parameter] += z / prior.sigma;
    equations.squares += z * z;
  }
  AddSmoothness(smoothness, equations.matrix);
  for (const SmoothnessRow& row : smoothness) {
    const double value = row.Value(x);
    for (const auto& [parameter, coefficient] : row.terms)
      equations.gradient[parameter] += coefficient * value;
    equations.squares += value * value;
  }
}

std::optional<Prediction> SolveFrozen(const FrozenProblem& problem, const InnerSolveOptions& options,
                                      Eigen::VectorXd& x) {
  const Eigen::VectorXd start = x;
  std::optional<Prediction> last;
  Eigen::VectorXd last_at;
  CondensedProblem condensed;
  condensed.equations = [&](const Eigen::VectorXd& at) -> std::optional<NormalEquations> {
    if (at == start) return EquationsOf(problem, problem.at_base, at);
    last =
        problem.model.Predict(WithParameters(problem.base, problem.parameters, at), problem.parameters, true);
    last_at = at;
    if (!last->value.allFinite()) return std::nullopt;
    return EquationsOf(problem, *last, at);
  };
  condensed.lower.resize(x.size());
  condensed.upper.resize(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    condensed.lower[i] = problem.parameters[static_cast<size_t>(i)].lower;
    condensed.upper[i] = problem.parameters[static_cast<size_t>(i)].upper;
  }
  SolveCondensed(condensed, options, x);
  if (last && last_at != x) last.reset();
  return last;
}

}  // namespace luxfit
