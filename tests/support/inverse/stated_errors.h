// Errors of a fit against the truth of its room, beside the covariance that the fit states of them.
//
//   mean = w^T e,   standard error = sqrt(w^T C w),   w_i = (1 / C_ii) / sum_j (1 / C_jj)
//
// e: estimates less truth, C: their joint covariance, which holds what the errors share. Positions in m, logarithms of
// fluxes, reflectances.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_STATED_ERRORS_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_STATED_ERRORS_H_

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace luxfit::support {

struct MeanError {
  double mean = 0, standard_error = 0;
  double Z() const { return mean / standard_error; }
};

struct StatedErrors {
  std::vector<std::string> kind,
      quantity;  // words of inverse/model/parameter.h; a parameter without a quantity: ""
  Eigen::VectorXd error;
  Eigen::MatrixXd covariance;

  // Returns the rows of a kind ("": all) and a quantity ("": all).
  std::vector<Eigen::Index> RowsOf(const std::string& of_kind, const std::string& of_quantity = "") const {
    std::vector<Eigen::Index> rows;
    for (size_t i = 0; i < kind.size(); ++i) {
      if ((of_kind.empty() || kind[i] == of_kind) && (of_quantity.empty() || quantity[i] == of_quantity))
        rows.push_back(static_cast<Eigen::Index>(i));
    }
    return rows;
  }

  // Returns chi2 of the errors of one kind ("": of all), over their number.
  double Chi2Each(const std::string& of_kind) const {
    const std::vector<Eigen::Index> own = RowsOf(of_kind);
    const Eigen::VectorXd part = error(own);
    return part.dot(Eigen::MatrixXd(covariance(own, own)).ldlt().solve(part)) /
           static_cast<double>(own.size());
  }

  // Returns the largest sigma of one kind.
  double LargestSigma(const std::string& of_kind) const {
    double largest = 0;
    for (const Eigen::Index row : RowsOf(of_kind))
      largest = std::max(largest, std::sqrt(covariance(row, row)));
    return largest;
  }

  MeanError MeanOf(const std::vector<Eigen::Index>& rows) const {
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(error.size());
    for (const Eigen::Index row : rows) weight[row] = 1 / covariance(row, row);
    weight /= weight.sum();
    return {weight.dot(error), std::sqrt(weight.dot(covariance * weight))};
  }
};

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_STATED_ERRORS_H_
