#include "forward/radiosity/internal/dense.h"

#include <cblas.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr float kRounding = std::numeric_limits<float>::epsilon();

Eigen::MatrixXf RandomMatrix(std::mt19937_64& rng, Eigen::Index rows, Eigen::Index columns) {
  std::uniform_real_distribution<float> uniform(-1, 1);
  return Eigen::MatrixXf::NullaryExpr(rows, columns, [&] { return uniform(rng); });
}

// Returns a matrix whose smallest eigenvalue is 1 or more.
Eigen::MatrixXf RandomPositiveDefinite(std::mt19937_64& rng, Eigen::Index order) {
  const Eigen::MatrixXf root = RandomMatrix(rng, order, order) / std::sqrt(static_cast<float>(order));
  return Eigen::MatrixXf::Identity(order, order) + root * root.transpose();
}

#ifdef __x86_64__
// OpenBLAS falls back to the kernels of this name for processors that it does not know.
TEST(DenseKernels, AreNotTheOldestOnAProcessorOfToday) {
  const bool is_of_today = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  EXPECT_TRUE(!is_of_today || std::string(openblas_get_corename()) != "Prescott");
}
#endif

// 600 rows are two whole panels of 256 and a part of one.
TEST(DenseKernels, CholeskySolvesWhatDoublePrecisionSolves) {
  std::mt19937_64 rng = support::TestRng();
  const Eigen::MatrixXf matrix = RandomPositiveDefinite(rng, 600), right = RandomMatrix(rng, 600, 11);
  Eigen::MatrixXf lower = matrix, solution = right;
  ASSERT_TRUE(CholeskyInPlace(lower));
  CholeskySolveInPlace(lower, solution);
  const Eigen::MatrixXd expected = matrix.cast<double>().llt().solve(right.cast<double>());
  // Eigenvalues lie in [1, 1 + 4 / 3]. Source: Marchenko and Pastur (1967), of products of variance 1 / 3.
  const double condition = 2.4;
  EXPECT_LT((solution.cast<double>() - expected).norm() / expected.norm(), condition * kRounding);
}

TEST(DenseKernels, CholeskyRefusesWhatIsNotPositiveDefinite) {
  std::mt19937_64 rng = support::TestRng();
  Eigen::MatrixXf matrix = RandomPositiveDefinite(rng, 600);
  matrix(500, 500) = -1;
  EXPECT_FALSE(CholeskyInPlace(matrix));
}

TEST(DenseKernels, RowsOfAProductAreThoseOfTheWholeProduct) {
  std::mt19937_64 rng = support::TestRng();
  const FormFactorMatrix a = RandomMatrix(rng, 700, 40);
  for (const Eigen::Index columns : {1, 9}) {
    const Eigen::MatrixXf b = RandomMatrix(rng, 40, columns);
    const Eigen::MatrixXd whole = a.cast<double>() * b.cast<double>();
    const Eigen::MatrixXf rows = RowsProduct(a, 37, 600, b);
    // 40 products of at most 1, each rounded.
    EXPECT_LT((rows.cast<double>() - whole.middleRows(37, 600)).cwiseAbs().maxCoeff(), 40 * kRounding)
        << columns;
  }
}

}  // namespace
}  // namespace luxfit
