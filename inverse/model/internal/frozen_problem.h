// Solves the fit's inner least-squares problem while visibility, weights and model error stand still.
//
//   min over x  sum_i (u_i (model_i(x) - data_i))^2 + priors + smoothness,   u = root weight
//
// Ceres receives a condensate in place of the rows: as many rows as parameters and one more, with the same
// cost, gradient and Gauss-Newton matrix at every x:
//   J^T J = D V L V^T D,   R = L^(1/2) V^T D,   s = L^(-1/2) V^T D^-1 J^T r,   c = |r|^2 - |s|^2
// D: root of the diagonal, V L V^T: eigenvectors and values of the scaled matrix. Each step thus reads tens
// of thousands of rows only once, on all cores.
//
// Sources: Nocedal and Wright (2006), ch. 10; Ceres Solver documentation, "Modeling Non-linear Least
// Squares".
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_FROZEN_PROBLEM_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_FROZEN_PROBLEM_H_

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/model/internal/light_model.h"
#include "inverse/model/internal/part_smoothness.h"

namespace luxfit {

using IndexedPriors = std::vector<std::pair<int, ParameterPrior>>;  // index of the parameter, prior

// Returns the priors that concern one of the parameters.
IndexedPriors PriorsOf(const std::vector<Parameter>& parameters, const std::vector<ParameterPrior>& priors);

// Holds the Gauss-Newton equations of a sum of squares.
struct NormalEquations {
  Eigen::MatrixXd matrix;    // J^T J
  Eigen::VectorXd gradient;  // J^T r
  double squares = 0;        // |r|^2

  explicit NormalEquations(Eigen::Index n)
      : matrix(Eigen::MatrixXd::Zero(n, n)), gradient(Eigen::VectorXd::Zero(n)) {}

  void Add(const NormalEquations& other) {
    matrix += other.matrix;
    gradient += other.gradient;
    squares += other.squares;
  }
  // Adds the squares of priors and smoothness at x.
  void Add(const IndexedPriors& priors, const std::vector<SmoothnessRow>& smoothness,
           const Eigen::VectorXd& x);
};

struct FrozenProblem {
  const LightModel& model;
  const LightState& base;  // tilts are relative to its aims
  const std::vector<Parameter>& parameters;
  const Eigen::VectorXd& data;
  const Eigen::VectorXd& root_weight;  // sqrt(w) / sigma, 0 for rows left out
  const IndexedPriors& priors;
  const std::vector<SmoothnessRow>& smoothness;
  const Prediction& at_base;  // with its Jacobian
};

struct InnerSolveOptions {
  int max_iterations = 12;
  // true: takes one accepted step, undamped. The weights are due again before a second step. One reading
  // alone may fix a direction (the scale of all fluxes). It has so little weight beside thousands of pixels
  // that damped steps stop tenths of a percent short.
  bool is_near = false;
};

// `x`: the start, at `base`; then the solution.
void SolveFrozen(const FrozenProblem& problem, const InnerSolveOptions& options, Eigen::VectorXd& x);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_FROZEN_PROBLEM_H_
