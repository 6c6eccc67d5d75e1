#include "forward/radiosity/internal/dense.h"

#include <cblas.h>
#include <lapack.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "forward/factors/form_factors.h"

// Functions of OpenBLAS that its headers leave out; absent where it was built for one processor alone.
extern "C" {
__attribute__((weak)) void gotoblas_dynamic_init();
__attribute__((weak)) void gotoblas_dynamic_quit();
}

namespace luxfit {
namespace {

// Chooses OpenBLAS's kernels by what the processor can do. OpenBLAS chooses by its model, and a model that is newer than
// the library gets kernels of 2004, a third as fast.
bool ChooseBlasKernels() {
#ifdef __x86_64__
  const bool is_unknown = std::string_view(openblas_get_corename()) == "Prescott";
  if (!is_unknown || std::getenv("OPENBLAS_CORETYPE") != nullptr || gotoblas_dynamic_init == nullptr ||
      gotoblas_dynamic_quit == nullptr || !__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    return false;
  const bool is_wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                       __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq");
  setenv("OPENBLAS_CORETYPE", is_wide ? "SkylakeX" : "Haswell", 1);
  gotoblas_dynamic_quit();
  gotoblas_dynamic_init();
  unsetenv("OPENBLAS_CORETYPE");  // other libraries of the process have an OpenBLAS of their own
  return true;
#else
  return false;
#endif
}

// Runs before main, while no thread can be in OpenBLAS.
[[maybe_unused]] const bool kHasChosenKernels = ChooseBlasKernels();

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

// Holds rows and columns of a column-major matrix, with its leading dimension.
struct Tile {
  float* data = nullptr;
  int rows = 0, columns = 0, stride = 0;
};
Tile TileOf(Eigen::MatrixXf& matrix, Eigen::Index row, Eigen::Index column, Eigen::Index rows,
            Eigen::Index columns) {
  return {&matrix(row, column), static_cast<int>(rows), static_cast<int>(columns),
          static_cast<int>(matrix.rows())};
}

// Factors the columns of a panel: its diagonal block, then the rows below.
bool FactorPanel(Eigen::MatrixXf& lower, Eigen::Index first, Eigen::Index width) {
  const lapack_int order = static_cast<lapack_int>(width), stride = static_cast<lapack_int>(lower.rows());
  lapack_int info = 0;
  LAPACK_spotrf("L", &order, &lower(first, first), &stride, &info);
  if (info != 0) return false;
  tbb::parallel_for(
      tbb::blocked_range<Eigen::Index>(first + width, lower.rows(), kRowsPerTask),
      [&](const tbb::blocked_range<Eigen::Index>& rows) {
        const Tile below = TileOf(lower, rows.begin(), first, static_cast<Eigen::Index>(rows.size()), width);
        cblas_strsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, below.rows,
                    below.columns, 1.0f, &lower(first, first), below.stride, below.data, below.stride);
      });
  return true;
}

// Subtracts the panel's product with its transpose from what is right of it and below.
void SubtractPanel(Eigen::MatrixXf& lower, Eigen::Index first, Eigen::Index width) {
  constexpr Eigen::Index kTile = 384;
  const Eigen::Index start = first + width, left = lower.rows() - start;
  const Eigen::Index tiles = (left + kTile - 1) / kTile;
  tbb::parallel_for(Eigen::Index{0}, tiles * tiles, [&](Eigen::Index index) {
    const Eigen::Index i = start + index / tiles * kTile, j = start + index % tiles * kTile;
    if (i < j) return;
    const Eigen::Index rows = std::min(kTile, lower.rows() - i), columns = std::min(kTile, lower.rows() - j);
    const Tile of_i = TileOf(lower, i, first, rows, width), of_j = TileOf(lower, j, first, columns, width);
    const Tile to = TileOf(lower, i, j, rows, columns);
    if (i == j) {
      cblas_ssyrk(CblasColMajor, CblasLower, CblasNoTrans, to.rows, of_i.columns, -1.0f, of_i.data,
                  of_i.stride, 1.0f, to.data, to.stride);
    } else {
      cblas_sgemm(CblasColMajor, CblasNoTrans, CblasTrans, to.rows, to.columns, of_i.columns, -1.0f,
                  of_i.data, of_i.stride, of_j.data, of_j.stride, 1.0f, to.data, to.stride);
    }
  });
}

}  // namespace

// Right-looking by panels. Source: Golub, Van Loan (2013), "Matrix Computations", alg. 4.2.3.
bool CholeskyInPlace(Eigen::MatrixXf& lower) {
  KeepBlasOnCallingThread();
  constexpr Eigen::Index kPanel = 256;
  for (Eigen::Index first = 0; first < lower.rows(); first += kPanel) {
    const Eigen::Index width = std::min(kPanel, lower.rows() - first);
    if (!FactorPanel(lower, first, width)) return false;
    SubtractPanel(lower, first, width);
  }
  return true;
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
