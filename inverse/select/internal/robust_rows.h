// Solves linear equations with strays among them, such as what two views show of one place.
//
//   value_i = sum_k c_ik x_k + noise * size_i,     x_k = mean +- sigma
//
// by iteratively reweighted least squares, first of absolute residuals, then with Cauchy's loss. The noise is that of the
// residuals' median over their sizes. Up to half of the rows may be strays.
// Source: Holland and Welsch (1977), "Robust regression using iteratively reweighted least-squares".
#ifndef LUXFIT_INVERSE_SELECT_INTERNAL_ROBUST_ROWS_H_
#define LUXFIT_INVERSE_SELECT_INTERNAL_ROBUST_ROWS_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace luxfit {

class RobustRows {
 public:
  static constexpr int kFolds = 5;
  struct Term {
    int at = 0;  // unknown
    double by = 1;
  };

  // `group`: rows of one share their error, and are left out together.
  void Add(const std::vector<Term>& terms, double value, double size, int group);
  // Adds all rows of another.
  void Add(const RobustRows& rows);
  size_t count() const { return rows_.size(); }
  int GroupOf(size_t row) const { return rows_[row].group; }
  int FoldOf(size_t row) const { return rows_[row].group % kFolds; }

  // Returns what remains of a row over its size.
  double Residual(size_t row, const Eigen::VectorXd& x) const;
  // Returns the noise of the rows but those of a fold; -1: of all.
  double NoiseAt(const Eigen::VectorXd& x, int without = -1) const;
  // Fits x to the rows but those of a fold, by a prior of that mean and sigma for each.
  Eigen::VectorXd Solve(double mean, double sigma, Eigen::Index unknowns, int without) const;

 private:
  struct Row {
    size_t first = 0, terms = 0;
    double value = 0, size = 1;
    int group = 0;
  };

  const Term* First(size_t row) const { return terms_.data() + rows_[row].first; }
  const Term* Last(size_t row) const { return First(row) + rows_[row].terms; }
  void AddTo(size_t row, double weight, Eigen::MatrixXd& normal, Eigen::VectorXd& right) const;

  std::vector<Row> rows_;
  std::vector<Term> terms_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_SELECT_INTERNAL_ROBUST_ROWS_H_
