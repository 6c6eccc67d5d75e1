// Computes how far measurements to come would shrink the covariance of a fit: linear design of experiments.
//
//   C' = (C^-1 + I)^-1 = L (1 + L^T I L)^-1 L^T,   C = L L^T,   I = sum J^T R^-1 J
//
// C: covariance of the parameters, J: derivatives of what would be measured, R: covariance of its errors. C may be
// singular: what was held stays held. Photos add the information of rows that share errors:
//
//   R = s_row^2 1 + s_patch^2 u u^T + s_view^2 v v^T
//
// u: 1 in the rows of one patch and state, which share the model's error; v: 1 in those of the photo, which share its
// gain. So rows of a patch and state that earlier photos show already add little, and the same element in the same
// state adds nothing. TakenRows holds the earlier ones.
//
// Real errors are shared more widely than that. VarianceInflation says how many times larger the variance of a fit is
// than its rows say: the median of the eigenvalues of I^1/2 C I^1/2 over the directions of which I tells, at least 1.
//
// All sigmas are relative. Assumes that the model is linear within the uncertainty.
// Throws std::invalid_argument for sizes that do not fit.
// Source: Fedorov (1972), "Theory of optimal experiments"; Woodbury (1950); Kish (1965), "Survey sampling".
#ifndef LUXFIT_INVERSE_ADVISE_INFORMATION_H_
#define LUXFIT_INVERSE_ADVISE_INFORMATION_H_

#include <Eigen/Core>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace luxfit {

// Returns L with L L^T = C, for any C without negative eigenvalues.
Eigen::MatrixXd CovarianceRoot(const Eigen::MatrixXd& covariance);

// Returns C'.
Eigen::MatrixXd CovarianceWith(const Eigen::MatrixXd& root, const Eigen::MatrixXd& information);

// Returns the variances by C' of linear quantities, one in each row.
Eigen::VectorXd VariancesWith(const Eigen::MatrixXd& root, const Eigen::MatrixXd& quantities,
                              const Eigen::MatrixXd& information);

double VarianceInflation(const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& information);

struct PhotoSigmas {
  double row = 0.01, patch = 0.01, view = 0.01;
};

// One row of a photo: an element in a state, and its patch.
struct PhotoRow {
  int element = 0, patch = 0, state = 0;
  Eigen::VectorXd derivative;  // of the logarithm of luminance, by parameter
};

class TakenRows {
 public:
  // `rows_per_element`: how many rows each given one stands for, where elements are a sample.
  TakenRows(const PhotoSigmas& sigmas, double rows_per_element)
      : sigmas_(sigmas), rows_per_element_(rows_per_element) {}

  // Returns the information that a photo of these rows would add.
  Eigen::MatrixXd InformationOf(const std::vector<PhotoRow>& photo) const;
  void Add(const std::vector<PhotoRow>& photo);

 private:
  struct Sums {
    double count = 0;
    Eigen::VectorXd derivative;
  };
  using Cluster = std::pair<int, int>;  // patch and state

  bool IsTaken(const PhotoRow& row) const { return taken_.count({row.element, row.state}) > 0; }
  // Returns the root x of what the shared error takes away of a cluster's information, x x^T, for sums over its rows.
  Eigen::VectorXd SharedPart(double count, const Eigen::VectorXd& sum) const;

  PhotoSigmas sigmas_;
  double rows_per_element_;
  std::map<Cluster, Sums> clusters_;
  std::set<std::pair<int, int>> taken_;  // element and state
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ADVISE_INFORMATION_H_
