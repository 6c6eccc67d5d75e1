#include "inverse/model/fit_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "inverse/model/fit_luminaires.h"

namespace luxfit {
namespace {

constexpr double kUnknownCovariance = std::numeric_limits<double>::quiet_NaN();

// Returns the row of a parameter; -1 where the fit held it.
Eigen::Index RowOf(const std::vector<ParameterId>& parameters, const ParameterId& parameter) {
  const auto at = std::find(parameters.begin(), parameters.end(), parameter);
  return at == parameters.end() ? -1 : at - parameters.begin();
}

}  // namespace

std::vector<ParameterId> FitUncertainty::Undetermined() const {
  std::vector<ParameterId> undetermined;
  for (size_t i = 0; i < parameters.size(); ++i)
    if (!is_determined[i]) undetermined.push_back(parameters[i]);
  return undetermined;
}

double FitUncertainty::Covariance(const ParameterId& a, const ParameterId& b) const {
  const Eigen::Index i = RowOf(parameters, a), j = RowOf(parameters, b);
  if (i < 0 || j < 0) return 0;
  if (!is_determined[static_cast<size_t>(i)] || !is_determined[static_cast<size_t>(j)])
    return kUnknownCovariance;
  return i < covariance.rows() && j < covariance.cols() ? covariance(i, j) : kUnknownCovariance;
}

double FitUncertainty::Sigma(const ParameterId& parameter) const {
  return std::sqrt(Covariance(parameter, parameter));
}

FitUncertainty UncertaintyOf(const LuminaireFit& fit) {
  FitUncertainty uncertainty;
  uncertainty.parameters.reserve(fit.parameters.size());
  uncertainty.is_determined.reserve(fit.parameters.size());
  for (const Parameter& p : fit.parameters) {
    uncertainty.parameters.push_back(p.id());
    uncertainty.is_determined.push_back(
        std::count(fit.undetermined.begin(), fit.undetermined.end(), p.id()) == 0);
  }
  uncertainty.values = PackParameters(fit.state, fit.parameters);
  uncertainty.covariance = fit.covariance;
  uncertainty.relative_model_sigma = fit.shared_relative_sigma;
  return uncertainty;
}

Eigen::Matrix3d PositionCovariance(const FitUncertainty& fit, const std::string& luminaire) {
  Eigen::Matrix3d covariance;
  const auto id = [&](int axis) {
    return ParameterId{ParameterKind::kLuminaire, luminaire, static_cast<LuminaireQuantity>(axis)};
  };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) covariance(i, j) = fit.Covariance(id(i), id(j));
  }
  return covariance;
}

Eigen::MatrixXd FluxCovariance(const FitUncertainty& fit, const std::vector<Luminaire>& luminaires) {
  const Eigen::Index count = static_cast<Eigen::Index>(luminaires.size());
  Eigen::MatrixXd covariance(count, count);
  const auto id = [&](Eigen::Index k) {
    return ParameterId{ParameterKind::kLogFlux, luminaires[static_cast<size_t>(k)].id};
  };
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) covariance(i, j) = fit.Covariance(id(i), id(j));
  }
  return covariance;
}

}  // namespace luxfit
