// Errors of a run against the truth of its room. `fit`: stages/fit.json, `truth`: a fixture's truth.json. Reflectances are
// weighted 0.265, 0.670, 0.065.
#ifndef LUXFIT_TESTS_SUPPORT_APPS_ERRORS_OF_RUN_H_
#define LUXFIT_TESTS_SUPPORT_APPS_ERRORS_OF_RUN_H_

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/inverse/stated_errors.h"

namespace luxfit::support {

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

#endif  // LUXFIT_TESTS_SUPPORT_APPS_ERRORS_OF_RUN_H_
