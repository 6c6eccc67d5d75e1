// Solves least squares with few unknowns and very many rows by Ceres, from the normal equations of the rows.
//
//   min over x  |r(x)|^2,   lower <= x <= upper
//
// Ceres receives a condensate in place of the rows: as many rows as unknowns and one more, with the same
// cost, gradient and Gauss-Newton matrix at every x:
//   J^T J = D V L V^T D,   R = L^(1/2) V^T D,   s = L^(-1/2) V^T D^-1 J^T r,   c = |r|^2 - |s|^2
// D: root of the diagonal, V L V^T: eigenvectors and values of the scaled matrix. Each step thus reads the
// rows only once, on all cores, and they need not be kept.
//
// Unknowns that single groups of rows have for themselves are eliminated before: the equations are then the
// reduced ones (variable projection), and Ceres sees the shared unknowns alone. Who uses it: the light of a
// room (frozen_problem.h) and photometric stereo (inverse/albedo/internal/pixel_elimination.h).
//
// Sources: Nocedal and Wright (2006), ch. 10; Golub and Pereyra (1973); Ceres Solver documentation, "Modeling
// Non-linear Least Squares".
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_CONDENSED_PROBLEM_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_CONDENSED_PROBLEM_H_

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace luxfit {

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
};

struct CondensedProblem {
  // Returns the equations at x; none where the model is undefined there. The same x gives the same equations.
  std::function<std::optional<NormalEquations>(const Eigen::VectorXd& x)> equations;
  Eigen::VectorXd lower, upper;  // bounds of x
};

struct InnerSolveOptions {
  int max_iterations = 12;
  // true: takes one accepted step, undamped. The weights are due again before a second step. One reading
  // alone may fix a direction (the scale of all fluxes). It has so little weight beside thousands of pixels
  // that damped steps stop tenths of a percent short.
  bool is_near = false;
  double near_radius = 1e8;  // of the trust region at that step; 1 / radius is the damping
  // Ends a near solve where a rejected step promised to lower |r|^2 by less: what rounding or inexact derivatives spoil
  // then is not worth damped steps, of which it would take many.
  double negligible_decrease = 0;
};

// `x`: the start, within the bounds; then the solution. Returns the radius of the trust region that the
// next near step may start with.
double SolveCondensed(const CondensedProblem& problem, const InnerSolveOptions& options, Eigen::VectorXd& x);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_CONDENSED_PROBLEM_H_
