// Wraps dense single-precision kernels of BLAS and LAPACK in Eigen's types.
//
// The library picks its kernels for the processor at run time, so the build needs no processor flags.
#ifndef LUXFIT_FORWARD_RADIOSITY_INTERNAL_DENSE_H_
#define LUXFIT_FORWARD_RADIOSITY_INTERNAL_DENSE_H_

#include <Eigen/Core>

#include "forward/factors/form_factors.h"

namespace luxfit {

// Replaces the matrix by its lower Cholesky factor (column-major, only the lower triangle is read and
// written); false: not positive definite.
bool CholeskyInPlace(Eigen::MatrixXf& lower);
// Solves L L^T X = B in place.
void CholeskySolveInPlace(const Eigen::MatrixXf& lower, Eigen::MatrixXf& right);
// Solves A X = B by LU with partial pivoting, both in place; false: singular.
bool LuSolveInPlace(Eigen::MatrixXf& matrix, Eigen::MatrixXf& right);
// Returns rows [first, first + count) of a b.
Eigen::MatrixXf RowsProduct(const FormFactorMatrix& a, Eigen::Index first, Eigen::Index count,
                            const Eigen::MatrixXf& b);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_RADIOSITY_INTERNAL_DENSE_H_
