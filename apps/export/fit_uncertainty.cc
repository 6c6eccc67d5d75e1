#include "apps/export/fit_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/stages/parameter_json.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/json_vectors.h"
#include "apps/text/input_error.h"

namespace luxfit {
namespace {

using nlohmann::json;

template <typename Value>
Eigen::Index IndexOf(const std::vector<Value>& list, const Value& value) {
  const auto at = std::find(list.begin(), list.end(), value);
  return at == list.end() ? -1 : at - list.begin();
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::vector<ParameterId> FitUncertainty::Undetermined() const {
  std::vector<ParameterId> undetermined;
  for (size_t i = 0; i < parameters.size(); ++i)
    if (!is_determined[i]) undetermined.push_back(parameters[i]);
  return undetermined;
}

bool FitUncertainty::Has(const ParameterId& parameter) const { return IndexOf(parameters, parameter) >= 0; }

double FitUncertainty::Covariance(const ParameterId& a, const ParameterId& b) const {
  const Eigen::Index i = IndexOf(parameters, a), j = IndexOf(parameters, b);
  if (i < 0 || j < 0) return 0;
  if (!is_determined[static_cast<size_t>(i)] || !is_determined[static_cast<size_t>(j)]) return kUnknown;
  return i < covariance.rows() && j < covariance.cols() ? covariance(i, j) : kUnknown;
}

double FitUncertainty::Sigma(const ParameterId& parameter) const {
  return std::sqrt(Covariance(parameter, parameter));
}

FitUncertainty ReadFitUncertainty(const std::string& out) {
  const std::string path = out + "/stages/fit.json";
  try {
    const json fit = ReadJson(path);
    FitUncertainty uncertainty;
    json values = json::array();
    for (const json& parameter : fit.at("parameters")) {
      uncertainty.parameters.push_back(IdFromJson(parameter));
      uncertainty.is_determined.push_back(parameter.at("determined"));
      values.push_back(parameter.at("value"));
    }
    uncertainty.values = VectorFromJson(values);
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
  const ParameterId camera{ParameterKind::kLogCameraScale, ""};
  for (const json& material : fitted.result->at("materials")) {
    const auto& names = fitted.room.scene.materials;
    const Eigen::Index m = IndexOf(names, material.at("name").get<std::string>());
    if (m < 0 || material.at("albedo").is_null()) continue;
    const ParameterId albedo{ParameterKind::kAlbedo, names[static_cast<size_t>(m)]};
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
  const auto id = [&](int axis) {
    return ParameterId{ParameterKind::kLuminaire, luminaire, static_cast<LuminaireQuantity>(axis)};
  };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) covariance(i, j) = uncertainty.Covariance(id(i), id(j));
  }
  return covariance;
}

Eigen::MatrixXd FluxCovariance(const FittedRoom& fitted, const FitUncertainty& uncertainty) {
  const Eigen::Index count = static_cast<Eigen::Index>(fitted.luminaires.size());
  Eigen::MatrixXd covariance(count, count);
  const auto id = [&](Eigen::Index k) {
    return ParameterId{ParameterKind::kLogFlux, fitted.luminaires[static_cast<size_t>(k)].id};
  };
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) covariance(i, j) = uncertainty.Covariance(id(i), id(j));
  }
  return covariance;
}

}  // namespace luxfit
