#include "apps/session/photos/internal/least_cost.h"

#include <limits>
#include <stdexcept>

namespace luxfit {
namespace {

constexpr int kNoRow = -1;

// Prices of rows and columns, such that no cost is below the sum of its two prices; and the row of each column.
struct Prices {
  Eigen::VectorXd of_row, of_column;
  std::vector<int> row_of;
};

// Gives `row` a column, and moves others along the cheapest path that ends at a free column.
void Augment(const Eigen::MatrixXd& cost, int row, Prices& prices) {
  const auto columns = static_cast<size_t>(cost.cols());
  std::vector<double> way(columns, std::numeric_limits<double>::infinity());
  std::vector<int> before(columns, -1);
  std::vector<bool> is_done(columns, false);
  int at_row = row, last = -1;
  while (at_row != kNoRow) {
    int nearest = -1;
    for (size_t j = 0; j < columns; ++j) {
      if (is_done[j]) continue;
      const auto c = static_cast<Eigen::Index>(j);
      const double step = cost(at_row, c) - prices.of_row[at_row] - prices.of_column[c];
      if (step < way[j]) {
        way[j] = step;
        before[j] = last;
      }
      if (nearest < 0 || way[j] < way[static_cast<size_t>(nearest)]) nearest = static_cast<int>(j);
    }
    // Prices move so that the next step is free; `way` counts from there.
    const double least = way[static_cast<size_t>(nearest)];
    prices.of_row[row] += least;
    for (size_t j = 0; j < columns; ++j) {
      if (is_done[j]) {
        prices.of_row[prices.row_of[j]] += least;
        prices.of_column[static_cast<Eigen::Index>(j)] -= least;
      } else {
        way[j] -= least;
      }
    }
    is_done[static_cast<size_t>(nearest)] = true;
    last = nearest;
    at_row = prices.row_of[static_cast<size_t>(nearest)];
  }
  for (int column = last; column >= 0; column = before[static_cast<size_t>(column)]) {
    const int from = before[static_cast<size_t>(column)];
    prices.row_of[static_cast<size_t>(column)] = from >= 0 ? prices.row_of[static_cast<size_t>(from)] : row;
  }
}

}  // namespace

std::vector<int> LeastCostColumns(const Eigen::MatrixXd& cost) {
  if (cost.rows() > cost.cols()) throw std::invalid_argument("LeastCostColumns: expected rows <= columns");
  if (!cost.allFinite()) throw std::invalid_argument("LeastCostColumns: expected finite costs");
  Prices prices{Eigen::VectorXd::Zero(cost.rows()), Eigen::VectorXd::Zero(cost.cols()),
                std::vector<int>(static_cast<size_t>(cost.cols()), kNoRow)};
  for (int row = 0; row < cost.rows(); ++row) Augment(cost, row, prices);
  std::vector<int> columns(static_cast<size_t>(cost.rows()), -1);
  for (size_t j = 0; j < prices.row_of.size(); ++j) {
    if (prices.row_of[j] != kNoRow) columns[static_cast<size_t>(prices.row_of[j])] = static_cast<int>(j);
  }
  return columns;
}

}  // namespace luxfit
