// Errors of a fit against the truth of its room, beside the covariance that the fit states of them.
//
//   mean = w^T e,   standard error = sqrt(w^T C w),   w = 1 / n for each of n errors
//
// e: estimates less truth, C: their joint covariance, which holds what the errors share. `fit`: stages/fit.json,
// `truth`: a fixture's truth.json. Positions in m, logarithms of fluxes, reflectances weighted 0.265, 0.670, 0.065.
#ifndef LUXFIT_TESTS_SUPPORT_APPS_STATED_ERRORS_H_
#define LUXFIT_TESTS_SUPPORT_APPS_STATED_ERRORS_H_

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace luxfit::support {

struct MeanError {
  double mean = 0, standard_error = 0;
  double Z() const { return mean / standard_error; }
};

struct StatedErrors {
  std::vector<std::string> kind, quantity;  // as in `fit`; a parameter without a quantity: ""
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
    for (const Eigen::Index row : rows) weight[row] = 1 / static_cast<double>(rows.size());
    return {weight.dot(error), std::sqrt(weight.dot(covariance * weight))};
  }
};

inline StatedErrors ErrorsOf(const nlohmann::json& fit, const nlohmann::json& truth) {
  using nlohmann::json;
  std::map<std::string, json> lamps;
  for (const json& lamp : truth["lamps"]) lamps[lamp["id"]] = lamp;
  const Eigen::Vector3d weights(0.265, 0.670, 0.065);
  StatedErrors errors;
  std::vector<Eigen::Index> own;
  std::vector<double> error;
  for (size_t i = 0; i < fit["parameters"].size(); ++i) {
    const json& p = fit["parameters"][i];
    const std::string kind = p["kind"], quantity = p.value("quantity", "");
    double true_value = 0;
    if (kind == "luminaire" && quantity.rfind("position_", 0) == 0) {
      true_value = lamps[p["luminaire"]]["position"][static_cast<size_t>(quantity.back() - 'x')];
    } else if (kind == "log_flux") {
      true_value = std::log(lamps[p["luminaire"]]["flux_lm"].get<double>());
    } else if (kind == "albedo") {
      const json& rgb = truth["materials"][p["material"].get<std::string>()];
      for (size_t c = 0; c < 3; ++c)
        true_value += weights[static_cast<Eigen::Index>(c)] * rgb[c].get<double>();
    } else {
      continue;
    }
    own.push_back(static_cast<Eigen::Index>(i));
    errors.kind.push_back(kind);
    errors.quantity.push_back(quantity);
    error.push_back(p["value"].get<double>() - true_value);
  }
  const size_t n = fit["covariance"].size();
  Eigen::MatrixXd covariance(n, n);
  for (size_t i = 0; i < n; ++i)
    for (size_t j = 0; j < n; ++j)
      covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = fit["covariance"][i][j];
  errors.error = Eigen::Map<Eigen::VectorXd>(error.data(), static_cast<Eigen::Index>(error.size()));
  errors.covariance = covariance(own, own);
  return errors;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_APPS_STATED_ERRORS_H_
