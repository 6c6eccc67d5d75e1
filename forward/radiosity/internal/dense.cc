#include "forward/radiosity/internal/dense.h"

#include <cblas.h>
#include <lapack.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <vector>

#include "forward/factors/form_factors.h"

namespace luxfit {
namespace {

// OpenBLAS's own threads wait by yielding, which on a busy machine costs a scheduler's turn at every barrier:
// minutes instead of seconds. It therefore computes on the calling thread, and the parallel loops here divide
// rows and columns among the threads.
void KeepBlasOnCallingThread() {
  static const bool once = [] {
    openblas_set_num_threads(1);
    return true;
  }();
  static_cast<void>(once);
}

constexpr Eigen::Index kRowsPerTask = 512, kRowsPerVectorTask = 64, kColumnsPerTask = 8;

}  // namespace

bool CholeskyInPlace(Eigen::MatrixXf& lower) {
  KeepBlasOnCallingThread();
  const lapack_int n = static_cast<lapack_int>(lower.rows());
  lapack_int info = 0;
  LAPACK_spotrf("L", &n, lower.data(), &n, &info);
  return info == 0;
}

void CholeskySolveInPlace(const Eigen::MatrixXf& lower, Eigen::MatrixXf& right) {
  KeepBlasOnCallingThread();
  const lapack_int n = static_cast<lapack_int>(lower.rows());
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, right.cols(), kColumnsPerTask),
                    [&](const tbb::blocked_range<Eigen::Index>& range) {
                      const lapack_int columns = static_cast<lapack_int>(range.size());
                      lapack_int info = 0;
                      LAPACK_spotrs("L", &n, &columns, lower.data(), &n, right.col(range.begin()).data(), &n,
                                    &info);
                    });
}

bool LuSolveInPlace(Eigen::MatrixXf& matrix, Eigen::MatrixXf& right) {
  KeepBlasOnCallingThread();
  const lapack_int n = static_cast<lapack_int>(matrix.rows()),
                   columns = static_cast<lapack_int>(right.cols());
  std::vector<lapack_int> pivots(static_cast<size_t>(n));
  lapack_int info = 0;
  LAPACK_sgesv(&n, &columns, matrix.data(), &n, pivots.data(), right.data(), &n, &info);
  return info == 0;
}

Eigen::MatrixXf RowsProduct(const FormFactorMatrix& a, Eigen::Index first, Eigen::Index count,
                            const Eigen::MatrixXf& b) {
  KeepBlasOnCallingThread();
  Eigen::MatrixXf c(count, b.cols());
  if (c.size() == 0) return c;
  const int inner = static_cast<int>(a.cols());
  if (b.cols() == 1) {  // gemm packs its operands: one pass too many where memory is the limit
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, count, kRowsPerVectorTask),
                      [&](const tbb::blocked_range<Eigen::Index>& range) {
                        cblas_sgemv(CblasColMajor, CblasTrans, inner, static_cast<int>(range.size()), 1.0f,
                                    a.row(first + range.begin()).data(), inner, b.data(), 1, 0.0f,
                                    c.data() + range.begin(), 1);
                      });
    return c;
  }
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, count, kRowsPerTask),
                    [&](const tbb::blocked_range<Eigen::Index>& range) {
                      // Rows of a, row-major, are columns of its transpose.
                      cblas_sgemm(CblasColMajor, CblasTrans, CblasNoTrans, static_cast<int>(range.size()),
                                  static_cast<int>(b.cols()), inner, 1.0f,
                                  a.row(first + range.begin()).data(), inner, b.data(),
                                  static_cast<int>(b.rows()), 0.0f, c.data() + range.begin(),
                                  static_cast<int>(c.rows()));
                    });
  return c;
}

Eigen::MatrixXf Product(const FormFactorMatrix& a, const Eigen::MatrixXf& b) {
  return RowsProduct(a, 0, a.rows(), b);
}

}  // namespace luxfit
