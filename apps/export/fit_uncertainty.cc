#include "apps/export/fit_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/text/artifact.h"
#include "apps/text/input_error.h"
#include "apps/text/json_vectors.h"

namespace luxfit {
namespace {

using nlohmann::json;

Eigen::Index IndexOf(const std::vector<std::string>& names, const std::string& name) {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? -1 : at - names.begin();
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

bool FitUncertainty::Has(const std::string& parameter) const { return IndexOf(parameters, parameter) >= 0; }

double FitUncertainty::Covariance(const std::string& a, const std::string& b) const {
  const Eigen::Index i = IndexOf(parameters, a), j = IndexOf(parameters, b);
  if (i < 0 || j < 0) return 0;
  for (const std::string& name : {a, b}) {
    if (IndexOf(undetermined, name) >= 0) return kUnknown;
  }
  return i < covariance.rows() && j < covariance.cols() ? covariance(i, j) : kUnknown;
}

double FitUncertainty::Sigma(const std::string& parameter) const {
  return std::sqrt(Covariance(parameter, parameter));
}

FitUncertainty ReadFitUncertainty(const std::string& out) {
  const std::string path = out + "/stages/fit.json";
  try {
    const json fit = ReadJson(path);
    FitUncertainty uncertainty;
    json values = json::array();
    for (const json& parameter : fit.at("parameters")) {
      uncertainty.parameters.push_back(parameter.at("name"));
      values.push_back(parameter.at("value"));
    }
    uncertainty.values = VectorFromJson(values);
    uncertainty.undetermined = fit.at("undetermined").get<std::vector<std::string>>();
    uncertainty.relative_model_sigma = fit.value("relative_model_error", 0.0);
    if (!fit.at("covariance").empty()) uncertainty.covariance = MatrixFromJson(fit.at("covariance"));
    return uncertainty;
  } catch (const json::exception& e) {
    throw InputError(
        {path, 0}, "",
        std::string("expected the fit of a run of this version; run `luxfit run` again; ") + e.what());
  }
}

SurfaceScale ScaleOfSurfaces(const FittedRoom& fitted, const FitUncertainty& uncertainty) {
  SurfaceScale scale;
  scale.camera_scale = fitted.camera_scale;
  scale.albedo = fitted.albedo;
  scale.relative_sigma = Eigen::VectorXd::Constant(fitted.albedo.size(), kUnknown);
  scale.relative_model_sigma = uncertainty.relative_model_sigma;
  const std::string camera = "log camera scale";
  for (const json& material : fitted.result->at("materials")) {
    const auto& names = fitted.room.scene.materials;
    const Eigen::Index m = IndexOf(names, material.at("name").get<std::string>());
    if (m < 0 || material.at("albedo").is_null()) continue;
    const std::string albedo = "albedo of " + names[static_cast<size_t>(m)];
    const double rho = fitted.albedo[m];
    const double variance = uncertainty.Covariance(camera, camera) +
                            2 * uncertainty.Covariance(camera, albedo) / rho +
                            uncertainty.Covariance(albedo, albedo) / (rho * rho);
    scale.relative_sigma[m] = std::sqrt(std::max(variance, 0.0));
  }
  return scale;
}

Eigen::Matrix3d PositionCovariance(const FitUncertainty& uncertainty, const std::string& luminaire) {
  Eigen::Matrix3d covariance;
  const auto name = [&](int axis) { return std::string("position ") + "xyz"[axis] + " of " + luminaire; };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) covariance(i, j) = uncertainty.Covariance(name(i), name(j));
  }
  return covariance;
}

Eigen::MatrixXd FluxCovariance(const FittedRoom& fitted, const FitUncertainty& uncertainty) {
  const Eigen::Index count = static_cast<Eigen::Index>(fitted.luminaires.size());
  Eigen::MatrixXd covariance(count, count);
  const auto name = [&](Eigen::Index k) {
    return "log flux of " + fitted.luminaires[static_cast<size_t>(k)].id;
  };
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) covariance(i, j) = uncertainty.Covariance(name(i), name(j));
  }
  return covariance;
}

}  // namespace luxfit
