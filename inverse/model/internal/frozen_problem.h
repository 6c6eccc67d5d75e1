// Solves the fit's inner least-squares problem while visibility, weights and model error stand still.
//
//   min over x  sum_i (u_i (model_i(x) - data_i))^2 + priors + smoothness,   u = root weight
//
// Each step sums tens of thousands of rows into their normal equations, which Ceres solves
// (inverse/model/internal/condensed_problem.h).
//
// Source: Nocedal and Wright (2006), ch. 10.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_FROZEN_PROBLEM_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_FROZEN_PROBLEM_H_

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/model/internal/condensed_problem.h"
#include "inverse/model/internal/light_model.h"
#include "inverse/model/internal/part_smoothness.h"
#include "inverse/model/internal/weights/row_weights.h"

namespace luxfit {

using IndexedPriors = std::vector<std::pair<int, ParameterPrior>>;  // index of the parameter, prior

// Returns the priors that concern one of the parameters.
IndexedPriors PriorsOf(const std::vector<Parameter>& parameters, const std::vector<ParameterPrior>& priors);

// Adds the squares of priors and smoothness at x.
void AddPriors(const IndexedPriors& priors, const std::vector<SmoothnessRow>& smoothness,
               const Eigen::VectorXd& x, NormalEquations& equations);

struct FrozenProblem {
  const LightModel& model;
  const LightState& base;  // tilts are relative to its aims
  const std::vector<Parameter>& parameters;
  const RowWeights& weights;
  const IndexedPriors& priors;
  const std::vector<SmoothnessRow>& smoothness;
  const Prediction& at_base;  // with its Jacobian
};

// `x`: the start, at `base`; then the solution. Returns the prediction there, with its Jacobian, if it was made last.
std::optional<Prediction> SolveFrozen(const FrozenProblem& problem, const InnerSolveOptions& options,
                                      Eigen::VectorXd& x);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_FROZEN_PROBLEM_H_
