#include "inverse/model/fit_uncertainty.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <stdexcept>

#include "forward/light/illuminance.h"
#include "inverse/model/internal/known_parameters.h"
#include "inverse/model/internal/light_model.h"

namespace luxfit {
namespace {

constexpr double kLeftOutVariance = 1e-3;

// Returns data with each luminaire alone at every place.
LightData DataOf(const std::vector<Sensor>& places, Eigen::Index luminaires) {
  LightData data;
  for (Eigen::Index k = 0; k < luminaires; ++k)
    data.dimming.emplace_back(Eigen::VectorXd::Unit(luminaires, k));
  data.readings.reserve(places.size() * static_cast<size_t>(luminaires));
  for (const Sensor& place : places) {
    for (int k = 0; k < static_cast<int>(luminaires); ++k) {
      Reading reading;
      reading.sensor = place;
      reading.state = k;
      data.readings.push_back(reading);
    }
  }
  return data;
}

// Returns S of J Sigma J^T, its columns by falling variance of the relative predictions.
Eigen::MatrixXd FactorOf(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& covariance) {
  if (jacobian.cols() == 0) return {};
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> root(0.5 * (covariance + covariance.transpose()));
  const Eigen::VectorXd sigmas = root.eigenvalues().cwiseMax(0).cwiseSqrt();
  const Eigen::MatrixXd whole = jacobian * root.eigenvectors() * sigmas.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(whole.transpose() * whole);
  const Eigen::VectorXd& variance = modes.eigenvalues();  // ascending
  const double all = variance.cwiseMax(0).sum();
  if (!(all > 0)) return {};
  Eigen::Index kept = variance.size();
  for (double left = 0; kept > 1; --kept) {
    left += std::max(0.0, variance[variance.size() - kept]);
    if (left > kLeftOutVariance * all) break;
  }
  return whole * modes.eigenvectors().rightCols(kept).rowwise().reverse();
}

PredictedPlaces WithoutCovariance(const Room& room, const std::vector<Luminaire>& luminaires,
                                  const Eigen::VectorXd& albedo, const std::vector<Sensor>& places) {
  const Receivers receivers = MakeReceivers(room, {}, places);
  const Illuminance light =
      ComputeIlluminance(room, receivers, ComputeVisibility(room, receivers, luminaires), luminaires, albedo);
  const Eigen::VectorXd flux_lm = FluxesLm(luminaires);
  return {light.total.cast<double>() * flux_lm.asDiagonal(),
          light.direct.cast<double>() * flux_lm.asDiagonal(),
          {},
          {}};
}

}  // namespace

PredictedPlaces PredictPlaces(const Room& room, const std::vector<Luminaire>& luminaires,
                              const Eigen::VectorXd& albedo, const std::vector<Sensor>& places,
                              const ParameterCovariance& given) {
  const auto count = static_cast<Eigen::Index>(given.parameters.size());
  if (given.covariance.rows() != count || given.covariance.cols() != count)
    throw std::invalid_argument("PredictPlaces: expected a covariance of as many rows as parameters");
  if (room.sparse || count == 0 || !given.covariance.allFinite())
    return WithoutCovariance(room, luminaires, albedo, places);
  const Eigen::Index lamps = static_cast<Eigen::Index>(luminaires.size());
  const LightState state = AllFree(room, luminaires, albedo);
  const KnownParameters known = FindKnown(FreeParameters(room, state), given);
  const LightData data = DataOf(places, lamps);
  LightModel model(room, data);
  model.FreezeVisibility(state);
  const Prediction predicted = model.Predict(state, known.parameters, true);
  const Eigen::Index rows = static_cast<Eigen::Index>(places.size());
  PredictedPlaces result;
  result.total_lx = Eigen::Map<const RowMajorMatrix>(predicted.value.data(), rows, lamps);
  result.direct_lx = Eigen::Map<const RowMajorMatrix>(predicted.direct.data(), rows, lamps);
  result.factor = FactorOf(predicted.jacobian, known.covariance);
  result.left_out = known.left_out;
  return result;
}

}  // namespace luxfit
