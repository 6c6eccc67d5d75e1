// One inner solve of the fit: least squares while visibility, weights and model error stand still.
//
//   min over x  sum_i (u_i (model_i(x) - data_i))^2 + priors + smoothness,   u = root weight
//
// Ceres is not given the rows but their condensate, as many rows as parameters and one more, with the same
// cost, gradient and Gauss-Newton matrix at every x:
//   J^T J = D V L V^T D,   R = L^(1/2) V^T D,   s = L^(-1/2) V^T D^-1 J^T r,   c = |r|^2 - |s|^2
// (D: root of the diagonal, V L V^T: eigenvectors and values of the scaled matrix.) Tens of thousands of rows
// are so read once for each step, on all cores.
//
// Sources: Nocedal and Wright (2006), ch. 10; Ceres Solver documentation, "Modeling Non-linear Least
// Squares".
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_FROZEN_PROBLEM_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_FROZEN_PROBLEM_H_

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/model/internal/part_smoothness.h"
#include "inverse/model/light_model.h"

namespace luxfit {

struct FrozenProblem {
  const LightModel& model;
  const LightState& base;  // tilts are relative to its aims
  const std::vector<Parameter>& parameters;
  const Eigen::VectorXd& data;
  const Eigen::VectorXd& root_weight;                         // sqrt(w) / sigma, 0 for rows left out
  const std::vector<std::pair<int, ParameterPrior>>& priors;  // parameter, knowledge
  const std::vector<SmoothnessRow>& smoothness;
  const Prediction& at_base;  // with its Jacobian
};

struct InnerSolveOptions {
  int max_iterations = 12;
  // One accepted step, undamped: the weights are due again before a second. A direction that one reading
  // alone fixes (the scale of all fluxes) has so little weight beside thousands of pixels that damped steps
  // stop tenths of a percent short of it.
  bool is_near = false;
};

// `x`: start, at `base`, and solution. Returns the cost there, half the sum of squares.
double SolveFrozen(const FrozenProblem& problem, const InnerSolveOptions& options, Eigen::VectorXd& x);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_FROZEN_PROBLEM_H_
