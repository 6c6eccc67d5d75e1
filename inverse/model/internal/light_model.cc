#include "inverse/model/internal/light_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "forward/light/covered_surfaces.h"
#include "inverse/model/internal/derivative_columns.h"

namespace luxfit {
namespace {

// Returns the index of `sensor` and adds it where it is new. A point read in several states is one sensor.
int IndexOf(const Sensor& sensor, std::vector<Sensor>& sensors) {
  const auto known = std::find(sensors.begin(), sensors.end(), sensor);
  const auto index = static_cast<int>(known - sensors.begin());
  if (known == sensors.end()) sensors.push_back(sensor);
  return index;
}

// Computes gain dE / dp at one receiver.
class ReceiverDerivative {
 public:
  ReceiverDerivative(const LightState& state, const std::vector<Parameter>& parameters,
                     const Illuminance& light, const DerivativeColumns& columns, bool is_direct)
      : state_(state),
        light_(light),
        whole_(columns.request().reflected ? light.total : light.direct),
        columns_(columns),
        is_direct_(is_direct) {
    for (const Parameter& p : parameters) share_.push_back(IsPart(p) ? ReferenceShare(state, p) : 0);
  }

  // `lumens`: of each luminaire in the row's state; `dimming`: of each group.
  double Of(const Parameter& parameter, size_t p, Eigen::Index r, double gain, const Eigen::VectorXd& lumens,
            const Eigen::VectorXd& dimming) const {
    const Eigen::Index k = parameter.index;
    if (parameter.kind == ParameterKind::kLogFlux) return gain * lumens[k] * light_.total(r, k);
    if (parameter.kind == ParameterKind::kAlbedo)
      return is_direct_ ? 0 : gain * Sum(light_.d_albedo, r, columns_.Of(p), dimming);
    if (parameter.kind != ParameterKind::kLuminaire) return 0;
    double sum = Sum(light_.d_luminaire, r, columns_.Of(p), dimming);
    if (IsPart(parameter)) {
      // Light of the whole, reflected or not as that of its parts.
      sum -= lumens[k] * whole_(r, k);
      for (const int j : parameter.tied) sum -= lumens[j] * whole_(r, j);
      return gain * share_[p] * sum;
    }
    // The parameter is the exponent's logarithm.
    const bool is_exponent = parameter.quantity == LuminaireQuantity::kExponent;
    return gain * sum * (is_exponent ? state_.luminaires[static_cast<size_t>(k)].cosine_exponent : 1);
  }

 private:
  static double Sum(const Eigen::MatrixXf& columns, Eigen::Index r,
                    const std::vector<DerivativeColumns::Term>& terms, const Eigen::VectorXd& dimming) {
    double sum = 0;
    for (const DerivativeColumns::Term& term : terms)
      sum += dimming[term.group] * static_cast<double>(columns(r, term.column));
    return sum;
  }

  const LightState& state_;
  const Illuminance& light_;
  const Eigen::MatrixXf& whole_;
  const DerivativeColumns& columns_;
  const bool is_direct_;
  std::vector<double> share_;  // of parts
};

}  // namespace

LightModel::LightModel(const Room& room, const LightData& data)
    : room_(room), data_(data), blocks_(RowBlocksOf(room, data)), groups_(GroupByDimming(data.dimming)) {
  if (data.indirect_is_held && !data.readings.empty())
    throw std::invalid_argument("LightModel: expected no readings where the indirect light was measured");
  std::vector<int> elements;
  std::vector<RowReceiver> receivers;
  for (size_t b = 0; b < blocks_.size(); ++b) {
    for (int place = 0; place < blocks_[b]->row_count(); ++place) {
      const RowReceiver receiver = blocks_[b]->ReceiverOf(place);
      if (receiver.state < 0 || receiver.state >= static_cast<int>(data.dimming.size()))
        throw std::invalid_argument("LightModel: expected a state index below " +
                                    std::to_string(data.dimming.size()));
      if (receiver.sensor == nullptr && receiver.element >= 0) elements.push_back(receiver.element);
      receivers.push_back(receiver);
      rows_.push_back({static_cast<int>(b), place, -1, receiver.state});
    }
  }
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  std::vector<Sensor> sensors;
  for (size_t i = 0; i < rows_.size(); ++i) {
    const RowReceiver& receiver = receivers[i];
    if (receiver.sensor == nullptr && receiver.element < 0) continue;
    rows_[i].receiver =
        receiver.sensor != nullptr
            ? static_cast<int>(elements.size()) + IndexOf(*receiver.sensor, sensors)
            : static_cast<int>(std::lower_bound(elements.begin(), elements.end(), receiver.element) -
                               elements.begin());
  }
  receivers_ = MakeReceivers(room, elements, sensors);
  if (!data.indirect_is_held) PrepareGather(room, receivers_);
}

void LightModel::FreezeVisibility(const LightState& state, int order) {
  visibility_ = (data_.indirect_is_held ? ComputeReceiverVisibility : ComputeVisibility)(
      room_, receivers_, state.luminaires, order);
  frozen_ = state.luminaires;
  frozen_order_ = order;
  FreezeReflected(state);
}

void LightModel::RefreezeVisibility(const LightState& state, int order, double still_m) {
  if (frozen_.size() != state.luminaires.size() || frozen_order_ != order)
    return FreezeVisibility(state, order);
  std::vector<int> moved;
  for (size_t k = 0; k < frozen_.size(); ++k) {
    if (!(MoveOf(frozen_[k], state.luminaires[k]) > still_m)) continue;
    moved.push_back(static_cast<int>(k));
    frozen_[k] = state.luminaires[k];
  }
  if (!moved.empty()) UpdateVisibility(room_, receivers_, state.luminaires, order, moved, visibility_);
  if (!moved.empty() || !reflected_is_frozen_) FreezeReflected(state);
}

void LightModel::TakeVisibility(const FrozenVisibility& frozen) {
  if (data_.indirect_is_held || frozen.elements.size() == 0) return;
  frozen_ = frozen.luminaires;
  frozen_order_ = frozen.order;
  visibility_.elements = frozen.elements;
  FillReceivers(room_, receivers_, frozen_, visibility_);
  reflected_is_frozen_ = false;
}

void LightModel::FreezeReflected(const LightState& state) {
  hidden_.resize(0), reflected_.resize(0), colour_.resize(0);
  reflected_is_frozen_ = true;
  if (data_.indirect_is_held || room_.sparse) return;
  const bool departs = state.tint.size() > 0 || patch_factor_.size() > 0;
  if (!departs && state.bodies == BodyPresence::kNone) return;
  const std::vector<Transport> channels = departs ? ChannelsOf(state) : std::vector<Transport>();
  std::vector<const Transport*> transports{&TransportFor(state.albedo)};
  transports.reserve(4);
  for (const Transport& channel : channels) transports.push_back(&channel);
  const std::vector<Eigen::MatrixXf> totals =
      ComputeTotals(room_, receivers_, visibility_, state.luminaires, transports);
  if (state.bodies != BodyPresence::kNone) FreezeBodies(state, totals.front());
  if (departs) FreezeColour(state, totals);
}

std::vector<Transport> LightModel::ChannelsOf(const LightState& state) const {
  std::vector<Transport> channels;
  channels.reserve(3);
  if (state.tint.size() == 0) channels.emplace_back(room_.transport, state.albedo, patch_factor_);
  for (Eigen::Index c = 0; c < state.tint.rows() && state.tint.size() > 0; ++c) {
    constexpr double kMostAlbedo = 0.99;
    channels.emplace_back(
        room_.transport,
        state.albedo.cwiseProduct(state.tint.row(c).transpose()).cwiseMin(kMostAlbedo).eval(), patch_factor_);
  }
  return channels;
}

void LightModel::FreezeColour(const LightState& state, const std::vector<Eigen::MatrixXf>& totals) {
  const Eigen::VectorXd flux = FluxesLm(state.luminaires);
  colour_.setOnes(row_count());
  for (Eigen::Index i = 0; i < row_count(); ++i) {
    const Row& row = rows_[static_cast<size_t>(i)];
    if (row.receiver < 0) continue;
    const Eigen::VectorXd lumens = data_.dimming[static_cast<size_t>(row.state)].cwiseProduct(flux);
    const Eigen::VectorXd weights =
        state.tint.size() > 0
            ? Eigen::VectorXd(blocks_[static_cast<size_t>(row.block)]->ChannelWeightsOf(state, row.place))
            : Eigen::VectorXd::Ones(1);
    const double grey_lx = totals[0].row(row.receiver).cast<double>().dot(lumens);
    double sum_lx = 0;
    for (Eigen::Index c = 0; c < weights.size(); ++c)
      sum_lx += weights[c] * totals[static_cast<size_t>(c) + 1].row(row.receiver).cast<double>().dot(lumens);
    if (grey_lx > 0) colour_[i] = sum_lx / grey_lx;
  }
}

void LightModel::FreezeBodies(const LightState& state, const Eigen::MatrixXf& total) {
  const std::vector<CoveredSurface> surfaces = FindCoveredSurfaces(room_, state.luminaires);
  if (surfaces.empty()) return;
  const CoveredLight covered = ComputeCoveredLight(room_, receivers_, visibility_, state.luminaires,
                                                   TransportFor(state.albedo), surfaces);
  const Eigen::VectorXd flux = FluxesLm(state.luminaires);
  hidden_.setZero(row_count()), reflected_.setZero(row_count());
  for (Eigen::Index i = 0; i < row_count(); ++i) {
    const Row& row = rows_[static_cast<size_t>(i)];
    if (row.receiver < 0) continue;
    const Eigen::VectorXd& dimming = data_.dimming[static_cast<size_t>(row.state)];
    const Eigen::VectorXd lumens = dimming.cwiseProduct(flux);
    const double illuminance_lx = total.row(row.receiver).cast<double>() * lumens;
    if (!(illuminance_lx > 0)) continue;
    const Eigen::VectorXd incident = covered.incident * lumens;
    for (size_t k = 0; k < surfaces.size(); ++k) {
      if (state.bodies == BodyPresence::kWhenOn && !(dimming[surfaces[k].luminaire] > 0)) continue;
      const auto column = static_cast<Eigen::Index>(k);
      const double share =
          surfaces[k].share * covered.response(row.receiver, column) * incident[column] / illuminance_lx;
      reflected_[i] += share;
      hidden_[i] += state.albedo[surfaces[k].material] * share;
    }
  }
}

std::vector<bool> LightModel::InPenumbra(double min_dimming) const {
  std::vector<bool> mixed(rows_.size());
  for (size_t i = 0; i < mixed.size(); ++i) {
    if (!BlockOf(static_cast<int>(i)).IsSpoiltByPenumbra()) continue;
    const Eigen::VectorXd& dimming = data_.dimming[static_cast<size_t>(rows_[i].state)];
    for (Eigen::Index k = 0; k < dimming.size(); ++k) {
      const float share = visibility_.receivers(rows_[i].receiver, k);
      if (dimming[k] > min_dimming && share > 0.001f && share < 0.999f) mixed[i] = true;
    }
  }
  return mixed;
}

Illuminance LightModel::Light(const LightState& state, const DerivativeRequest& request) const {
  if (data_.indirect_is_held)
    return ComputeDirectIlluminance(room_, receivers_, visibility_, state.luminaires, request);
  return ComputeIlluminance(room_, receivers_, visibility_, state.luminaires, TransportFor(state.albedo),
                            request);
}

const Transport& LightModel::TransportFor(const Eigen::VectorXd& albedo) const {
  if (!transport_ || transport_->albedo() != albedo) transport_.emplace(room_.transport, albedo);
  return *transport_;
}

Prediction LightModel::Predict(const LightState& state, const std::vector<Parameter>& parameters,
                               bool with_jacobian) const {
  const std::vector<Parameter> asked = with_jacobian ? parameters : std::vector<Parameter>();
  const DerivativeColumns columns(state, asked, groups_, reflects_derivatives_);
  const Illuminance light = Light(state, columns.request());
  const ReceiverDerivative derivative(state, asked, light, columns, data_.indirect_is_held);
  const Eigen::VectorXd flux = FluxesLm(state.luminaires);

  Prediction prediction;
  prediction.value.resize(row_count());
  prediction.direct.setZero(row_count());
  prediction.d_body.setZero(hidden_.size());
  if (with_jacobian) prediction.jacobian.setZero(row_count(), static_cast<Eigen::Index>(parameters.size()));
  tbb::parallel_for(0, row_count(), [&](int i) {
    const Row& row = rows_[static_cast<size_t>(i)];
    const RowBlock& block = *blocks_[static_cast<size_t>(row.block)];
    const Eigen::VectorXd lumens = data_.dimming[static_cast<size_t>(row.state)].cwiseProduct(flux);
    const RowResponse response = block.ResponseOf(state, row.place);
    const Eigen::VectorXd dimming = groups_.dimming.row(row.state);
    if (row.receiver < 0) {
      prediction.value[i] = response.offset;
      for (size_t p = 0; with_jacobian && p < parameters.size(); ++p)
        prediction.jacobian(i, static_cast<Eigen::Index>(p)) =
            block.OwnDerivative(state, parameters[p], 0, row.place);
      return;
    }
    const double unhidden_lx = light.total.row(row.receiver).cast<double>() * lumens;
    const double colour = colour_.size() > 0 ? colour_[i] : 1;
    const double left = colour * (hidden_.size() > 0 ? 1 - hidden_[i] + kBodyAlbedo * reflected_[i] : 1);
    const double illuminance_lx = left * unhidden_lx;
    if (hidden_.size() > 0) prediction.d_body[i] = response.gain * colour * unhidden_lx * reflected_[i];
    prediction.value[i] = response.gain * illuminance_lx + response.offset;
    prediction.direct[i] = response.gain * (light.direct.row(row.receiver).cast<double>() * lumens).value();
    for (size_t p = 0; with_jacobian && p < parameters.size(); ++p) {
      prediction.jacobian(i, static_cast<Eigen::Index>(p)) =
          derivative.Of(parameters[p], p, row.receiver, left * response.gain, lumens, dimming) +
          block.OwnDerivative(state, parameters[p], illuminance_lx, row.place);
    }
  });
  return prediction;
}

RowMajorMatrix LightModel::LightReflectedBy(const LightState& state,
                                            const std::vector<CoveredSurface>& surfaces) const {
  const CoveredLight light = ComputeCoveredLight(room_, receivers_, visibility_, state.luminaires,
                                                 TransportFor(state.albedo), surfaces);
  const Eigen::VectorXd flux = FluxesLm(state.luminaires);
  Eigen::VectorXd albedo(static_cast<Eigen::Index>(surfaces.size()));
  for (size_t k = 0; k < surfaces.size(); ++k)
    albedo[static_cast<Eigen::Index>(k)] = state.albedo[surfaces[k].material];
  RowMajorMatrix received = RowMajorMatrix::Zero(row_count(), albedo.size());
  for (Eigen::Index i = 0; i < row_count(); ++i) {
    const Row& row = rows_[static_cast<size_t>(i)];
    if (row.receiver < 0) continue;
    const Eigen::VectorXd lumens = data_.dimming[static_cast<size_t>(row.state)].cwiseProduct(flux);
    const double gain = blocks_[static_cast<size_t>(row.block)]->ResponseOf(state, row.place).gain;
    const Eigen::VectorXd reflected = albedo.cwiseProduct(light.incident * lumens);
    received.row(i) = gain * light.response.row(row.receiver).cwiseProduct(reflected.transpose());
  }
  return received;
}

}  // namespace luxfit
