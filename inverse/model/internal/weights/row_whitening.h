// Whitens rows whose errors have shared parts.
//
//   r = eps + U a,   eps ~ N(0, I), a ~ N(0, I):   Cov(r) = S = I + U U^T,   W = S^(-1/2)
//   W = I - U V diag((1 - (1 + l)^(-1/2)) / l) V^T U^T,   U^T U = V diag(l) V^T
//
// Rows are weighted by their own sigma already. Each group has its own U, at 1 sigma. A fit to W r is the fit
// in which every a was free, with its prior, and was eliminated (variable projection). What then remains of
// the rows is S^-1 r, the residual by the best a:
//   S^-1 r = r - U E[a | r],   its variance: diag(S^-1)
//
// Sources: Golub and Pereyra (1973) (variable projection); Searle, Casella, McCulloch (1992), "Variance
// components", ch. 6 (mixed models); Woodbury (1950).
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_ROW_WHITENING_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_ROW_WHITENING_H_

#include <Eigen/Core>
#include <vector>

namespace luxfit {

class RowWhitening {
 public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  // Adds a group with one shared error. A row may belong to one group only.
  void Add(const std::vector<Eigen::Index>& rows, const std::vector<double>& effect);
  // Adds a group of consecutive rows from `first`, each of which depends on the p quantities of one owner
  // (the pose of a view). effect: rows x p; root: (p owners) x shared errors, C = root root^T is the
  // covariance of all quantities.
  void Add(Eigen::Index first, const Eigen::MatrixXd& effect, const std::vector<int>& owner,
           const Eigen::MatrixXd& root);

  // Multiply by W in place.
  void Apply(Rows& rows) const;
  void Apply(Eigen::VectorXd& rows) const;
  // Returns S^-1 r.
  Eigen::VectorXd Remainder(Eigen::VectorXd rows) const;
  // Returns the diagonal of S^-1.
  Eigen::VectorXd RemainingVariance(Eigen::Index rows) const;

 private:
  struct Single {
    size_t first = 0, count = 0;  // in row_ and effect_
    double squares = 0;           // l
  };
  struct Block {
    Eigen::Index first = 0;
    Eigen::MatrixXd effect;
    std::vector<int> owner;
    Eigen::MatrixXd turned;   // root V
    Eigen::VectorXd squares;  // l

    // Returns U V of one row.
    Eigen::RowVectorXd Turned(Eigen::Index row) const;
  };
  template <typename Matrix>
  void ApplyTo(Matrix& rows) const;

  std::vector<Eigen::Index> row_;
  std::vector<double> effect_;
  std::vector<Single> singles_;
  std::vector<Block> blocks_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_ROW_WHITENING_H_
