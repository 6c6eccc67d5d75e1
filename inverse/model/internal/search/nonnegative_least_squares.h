// Solves non-negative least squares from the normal equations, for a few dozen unknowns.
//
//   min |A x - b|^2 over x >= 0,   G = A^T A,   m = A^T b
//
// The method is Lawson and Hanson's active set, started with every unknown positive (most are). Unknowns
// without weight in G (a zero column) are 0. Throws std::invalid_argument unless G is square and as long as
// m. Source: Lawson and Hanson (1974), "Solving Least Squares Problems", ch. 23.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_NONNEGATIVE_LEAST_SQUARES_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_NONNEGATIVE_LEAST_SQUARES_H_

#include <Eigen/Core>

namespace luxfit {

Eigen::VectorXd SolveNonNegative(const Eigen::MatrixXd& gram, const Eigen::VectorXd& moment);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_NONNEGATIVE_LEAST_SQUARES_H_
