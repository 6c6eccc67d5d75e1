// Solves for shares of light, robustly.
//
//   value_i = sum_k c_ik x_k + noise of (relative noise) size_i,     x_k = mean +- sigma
//
// by iteratively reweighted least squares, first of absolute residuals, then with Cauchy's loss. The relative noise is that of the
// residuals' median.
// Source: Holland and Welsch (1977), "Robust regression using iteratively reweighted least-squares".
#ifndef LUXFIT_INVERSE_OBSERVE_INTERNAL_SHARE_ROWS_H_
#define LUXFIT_INVERSE_OBSERVE_INTERNAL_SHARE_ROWS_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace luxfit {

class ShareRows {
 public:
  static constexpr int kFolds = 5;
  struct Term {
    int at = 0;  // unknown
    double by = 1;
  };

  // `group`: rows of one share their error, and are left out together.
  void Add(const std::vector<Term>& terms, double value, double size, int group);
  size_t count() const { return rows_.size(); }
  int GroupOf(size_t row) const { return rows_[row].group; }
  int FoldOf(size_t row) const { return rows_[row].group % kFolds; }

  // Returns what remains of a row over its size.
  double Residual(size_t row, const Eigen::VectorXd& x) const;
  // Returns the relative noise.
  double ScaleOf(const Eigen::VectorXd& x) const;
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

#endif  // LUXFIT_INVERSE_OBSERVE_INTERNAL_SHARE_ROWS_H_
