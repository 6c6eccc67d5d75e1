// Returns the x of a x = b for a small symmetric matrix a that is not negative, by LDL^T.
//
// The result is not finite where a is singular. The function is compiled once: the template in every file
// that solves a system of its own size takes the compiler minutes.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_SOLVE_SYMMETRIC_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_SOLVE_SYMMETRIC_H_

#include <Eigen/Core>

namespace luxfit {

Eigen::MatrixXd SolveSymmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_SOLVE_SYMMETRIC_H_
