#include "inverse/model/fitted_light.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "forward/light/element_albedo.h"
#include "forward/light/illuminance.h"
#include "inverse/model/fit_luminaires.h"
#include "inverse/model/internal/channel_transports.h"
#include "inverse/model/internal/intervals/known_parameters.h"
#include "inverse/model/internal/light_model.h"

namespace luxfit {
namespace {

constexpr double kLeftOutVariance = 1e-3;
constexpr int kLuminairePoints = 3;

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

Receivers AllElements(const Room& room) {
  std::vector<int> elements(room.patches.elements.size());
  std::iota(elements.begin(), elements.end(), 0);
  return MakeReceivers(room, elements, {});
}

}  // namespace

FittedScene FittedSceneOf(const LuminaireFit& fit, const LightData& data) {
  const LightState& state = fit.state;
  return {state.luminaires, state.albedo, state.bodies, state.tint, fit.patch_factor, data.luminance_weights};
}

Eigen::MatrixXd PlaceLight::While(const Eigen::VectorXd& dimming) const {
  if (body_response.size() == 0) return total_lx;
  const Eigen::VectorXd is_on = (dimming.array() > 0).cast<double>();
  return total_lx - body_response * is_on.asDiagonal() * body_incident;
}

Eigen::VectorXd PlaceLight::Under(const Eigen::VectorXd& dimming) const {
  Eigen::VectorXd light_lx = total_lx * dimming;
  if (body_response.size() == 0) return light_lx;
  const Eigen::VectorXd is_on = (dimming.array() > 0).cast<double>();
  return light_lx - body_response * is_on.cwiseProduct(body_incident * dimming);
}

FittedLight::FittedLight(const Room& room, FittedScene scene) : room_(room), scene_(std::move(scene)) {
  const Receivers elements = AllElements(room);
  const std::vector<Luminaire>& luminaires = scene_.luminaires;
  visibility_ = ComputeVisibility(room, elements, luminaires, kLuminairePoints);
  const std::vector<Eigen::VectorXd> channels = ChannelAlbedo(scene_.albedo, scene_.tint);
  std::vector<Transport> transports;
  transports.reserve(channels.size());
  for (const Eigen::VectorXd& channel : channels)
    transports.emplace_back(room.transport, channel, scene_.patch_factor);
  std::vector<const Transport*> others;
  for (size_t c = 1; c < channels.size(); ++c) others.push_back(&transports[c]);
  Illuminance first = ComputeIlluminance(room, elements, visibility_, luminaires, transports.front());
  std::vector<Eigen::MatrixXf> totals{std::move(first.total)};
  if (!others.empty()) {
    for (Eigen::MatrixXf& of_channel : ComputeTotals(room, elements, visibility_, luminaires, others))
      totals.push_back(std::move(of_channel));
  }
  Eigen::MatrixXf total = Eigen::MatrixXf::Zero(first.direct.rows(), first.direct.cols());
  exitance_ = total;
  for (size_t c = 0; c < channels.size(); ++c) {
    const double weight = channels.size() == 1 ? 1 : scene_.luminance_weights[static_cast<Eigen::Index>(c)];
    const Eigen::MatrixXf weighted = static_cast<float>(weight) * totals[c];
    total += weighted;
    exitance_ += ElementAlbedo(room.patches, channels[c], scene_.patch_factor).asDiagonal() * weighted;
  }
  transports.clear();  // they are large
  Eigen::MatrixXd body_response;
  if (scene_.bodies != BodyPresence::kNone) body_response = FindBodies(elements);
  at_elements_ = LightOf(total, first.direct, body_response);
}

Eigen::MatrixXd FittedLight::FindBodies(const Receivers& elements) {
  covered_ = FindCoveredSurfaces(room_, scene_.luminaires);
  if (covered_.empty()) return {};
  const Transport grey(room_.transport, scene_.albedo);
  CoveredLight light = ComputeCoveredLight(room_, elements, visibility_, scene_.luminaires, grey, covered_);
  on_covered_ = std::move(light.incident);
  body_exitance_ = ElementAlbedo(room_.patches, scene_.albedo).asDiagonal() * light.response.cast<float>();
  for (size_t s = 0; s < covered_.size(); ++s) {
    for (const auto& [element, covered_m2] : covered_[s].elements)
      body_exitance_(element, static_cast<Eigen::Index>(s)) +=
          static_cast<float>(covered_m2 / room_.patches.elements[static_cast<size_t>(element)].area_m2);
  }
  return std::move(light.response);
}

// Light is per lumen here, and `body_response` receivers x covered surfaces.
PlaceLight FittedLight::LightOf(const Eigen::MatrixXf& total, const Eigen::MatrixXf& direct,
                                const Eigen::MatrixXd& body_response) const {
  const Eigen::VectorXd flux_lm = FluxesLm(scene_.luminaires);
  PlaceLight light;
  light.total_lx = total.cast<double>() * flux_lm.asDiagonal();
  light.direct_lx = direct.cast<double>() * flux_lm.asDiagonal();
  if (covered_.empty()) return light;
  const bool always_there = scene_.bodies == BodyPresence::kAlways;
  light.total_lx -=
      HiddenLight(covered_, {body_response, on_covered_}, scene_.albedo, kBodyAlbedo, always_there) *
      flux_lm.asDiagonal();
  if (always_there) return light;
  light.body_response.setZero(total.rows(), flux_lm.size());
  light.body_incident.setZero(flux_lm.size(), flux_lm.size());
  for (size_t s = 0; s < covered_.size(); ++s) {
    const auto surface = static_cast<Eigen::Index>(s);
    const Eigen::Index own = covered_[s].luminaire;
    const double reflects_more = covered_[s].share * (scene_.albedo[covered_[s].material] - kBodyAlbedo);
    light.body_response.col(own) = body_response.col(surface);
    light.body_incident.row(own) = reflects_more * on_covered_.row(surface) * flux_lm.asDiagonal();
    light.body_incident(own, own) = 0;
  }
  return light;
}

PlaceLight FittedLight::LightAt(const std::vector<Sensor>& places, const ParameterCovariance& known,
                                int rays_per_sensor) const {
  const auto count = static_cast<Eigen::Index>(known.parameters.size());
  if (known.covariance.rows() != count || known.covariance.cols() != count)
    throw std::invalid_argument("FittedLight: expected a covariance of as many rows as parameters");
  if (count == 0 || !known.covariance.allFinite() || places.empty())
    return LightAt(MakeReceivers(room_, {}, places, rays_per_sensor));
  return WithFactor(places, known);
}

PlaceLight FittedLight::LightAt(const Receivers& sensors) const {
  const LuminaireVisibility visible =
      ComputeReceiverVisibility(room_, sensors, scene_.luminaires, kLuminairePoints);
  const Eigen::MatrixXf direct = ComputeDirectIlluminance(room_, sensors, visible, scene_.luminaires).direct;
  Eigen::MatrixXf total = direct;
  Eigen::MatrixXd body_response;
  if (exitance_.rows() > 0) total += sensors.sensor_to_element * exitance_;
  if (!covered_.empty()) body_response = (sensors.sensor_to_element * body_exitance_).cast<double>();
  return LightOf(total, direct, body_response);
}

PlaceLight FittedLight::WithFactor(const std::vector<Sensor>& places,
                                   const ParameterCovariance& given) const {
  const auto lamps = static_cast<Eigen::Index>(scene_.luminaires.size());
  const LightState state = AllFree(room_, scene_.luminaires, scene_.albedo);
  const KnownParameters known = FindKnown(FreeParameters(room_, state), given);
  const LightData data = DataOf(places, lamps);
  LightModel model(room_, data);
  // The rays of sensors cost most: the model's serve both.
  PlaceLight light = LightAt(model.receivers());
  std::vector<int> receiver_of_place;
  for (size_t i = 0; i < places.size(); ++i)
    receiver_of_place.push_back(model.ReceiverOf(static_cast<int>(i) * static_cast<int>(lamps)));
  light.total_lx = light.total_lx(receiver_of_place, Eigen::all).eval();
  light.direct_lx = light.direct_lx(receiver_of_place, Eigen::all).eval();
  if (light.body_response.size() > 0)
    light.body_response = light.body_response(receiver_of_place, Eigen::all).eval();
  model.TakeOver({scene_.luminaires, kLuminairePoints, {}, visibility_.elements, nullptr});
  model.RefreezeVisibility(state, kLuminairePoints);
  Prediction predicted = model.Predict(state, known.parameters, true);
  // Colours and bodies change each prediction by a factor, as in the fit.
  for (Eigen::Index row = 0; row < predicted.value.size(); ++row) {
    if (predicted.value[row] > 0)
      predicted.jacobian.row(row) *= light.total_lx(row / lamps, row % lamps) / predicted.value[row];
  }
  light.factor = FactorOf(predicted.jacobian, known.covariance);
  light.left_out = known.left_out;
  return light;
}

}  // namespace luxfit
