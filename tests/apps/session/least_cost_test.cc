#include "apps/session/photos/internal/least_cost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

// Tries every choice of columns.
double LeastByTrial(const Eigen::MatrixXd& cost) {
  std::vector<int> columns(static_cast<size_t>(cost.cols()));
  std::iota(columns.begin(), columns.end(), 0);
  double least = std::numeric_limits<double>::infinity();
  do {
    double sum = 0;
    for (int row = 0; row < cost.rows(); ++row) sum += cost(row, columns[static_cast<size_t>(row)]);
    least = std::min(least, sum);
  } while (std::next_permutation(columns.begin(), columns.end()));
  return least;
}

TEST(LeastCostTest, AsTrialOfAll) {
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const auto& [rows, columns] : {std::pair(1, 1), std::pair(3, 3), std::pair(4, 6), std::pair(6, 7)}) {
    const Eigen::MatrixXd cost = Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(rng); });
    const std::vector<int> chosen = LeastCostColumns(cost);
    double sum = 0;
    for (int row = 0; row < rows; ++row) sum += cost(row, chosen[static_cast<size_t>(row)]);
    EXPECT_NEAR(sum, LeastByTrial(cost), 1e-12) << rows << " x " << columns;
    std::vector<int> sorted = chosen;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end()) << "a column is taken twice";
  }
}

TEST(LeastCostTest, RefusesWhatHasNoAnswer) {
  EXPECT_THROW(LeastCostColumns(Eigen::MatrixXd::Zero(3, 2)), std::invalid_argument);
  EXPECT_THROW(LeastCostColumns(Eigen::MatrixXd::Constant(2, 2, std::nan(""))), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
