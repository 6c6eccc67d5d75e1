#include "forward/internal/dense.h"

#include <cblas.h>
#include <lapack.h>

#include "forward/dense_product.h"

namespace luxfit {

bool CholeskyInPlace(Eigen::MatrixXf& lower) {
  const lapack_int n = static_cast<lapack_int>(lower.rows());
  lapack_int info = 0;
  LAPACK_spotrf("L", &n, lower.data(), &n, &info);
  return info == 0;
}

void CholeskySolveInPlace(const Eigen::MatrixXf& lower, Eigen::MatrixXf& right) {
  const lapack_int n = static_cast<lapack_int>(lower.rows()), columns = static_cast<lapack_int>(right.cols());
  lapack_int info = 0;
  LAPACK_spotrs("L", &n, &columns, lower.data(), &n, right.data(), &n, &info);
}

Eigen::MatrixXf Product(const FormFactorMatrix& a, const Eigen::MatrixXf& b) {
  Eigen::MatrixXf c(a.rows(), b.cols());
  if (c.size() == 0) return c;
  // A row-major m x k is A^T column-major k x m.
  cblas_sgemm(CblasColMajor, CblasTrans, CblasNoTrans, static_cast<int>(a.rows()), static_cast<int>(b.cols()),
              static_cast<int>(a.cols()), 1.0f, a.data(), static_cast<int>(a.cols()), b.data(),
              static_cast<int>(b.rows()), 0.0f, c.data(), static_cast<int>(c.rows()));
  return c;
}

}  // namespace luxfit
