#include "inverse/model/internal/light_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "forward/light/covered_surfaces.h"
#include "inverse/model/internal/derivative_columns.h"
#include "inverse/model/internal/point_horizon.h"

namespace luxfit {
namespace {

// How far a reflectance moves before what colours and bodies do to reflected light is computed anew.
constexpr double kStillAlbedo = 0.01;
// The same for channels that are handed from fit to fit. Between strong colours the light then errs by 0.05 %.
constexpr double kServedAlbedo = 0.002;

// Returns the index of `sensor` and adds it where it is new. A point read in several states is one sensor.
int IndexOf(const Sensor& sensor, std::vector<Sensor>& sensors) {
  const auto known = std::find(sensors.begin(), sensors.end(), sensor);
  const auto index = static_cast<int>(known - sensors.begin());
  if (known == sensors.end()) sensors.push_back(sensor);
  return index;
}

// Computes gain dE / dp at receivers. Of each state, only parameters of light that is on have terms:
//   dE_r / dp = sum_t weight_t columns(r, t)
class ReceiverDerivative {
 public:
  // `dimming`: luminaires' of each state; `of_groups`: states x groups.
  ReceiverDerivative(const LightState& state, const std::vector<Parameter>& parameters,
                     const Illuminance& light, const DerivativeColumns& columns,
                     const std::vector<Eigen::VectorXd>& dimming, const Eigen::MatrixXd& of_groups,
                     bool is_direct)
      : terms_(dimming.size()) {
    if (parameters.empty()) return;
    const Eigen::MatrixXf& whole = columns.request().reflected ? light.total : light.direct;
    const Eigen::Index lamps = light.total.cols(), numbers = light.d_luminaire.cols();
    columns_.resize(light.total.rows(), 2 * lamps + numbers + (is_direct ? 0 : light.d_albedo.cols()));
    columns_.leftCols(lamps) = light.total;
    columns_.middleCols(lamps, lamps) = whole;
    columns_.middleCols(2 * lamps, numbers) = light.d_luminaire;
    if (!is_direct) columns_.rightCols(light.d_albedo.cols()) = light.d_albedo;
    const Eigen::VectorXd flux = FluxesLm(state.luminaires);
    for (size_t s = 0; s < dimming.size(); ++s) {
      const Eigen::VectorXd lumens = dimming[s].cwiseProduct(flux);
      const Eigen::VectorXd groups = of_groups.row(static_cast<Eigen::Index>(s));
      for (size_t p = 0; p < parameters.size(); ++p) {
        const Parameter& parameter = parameters[p];
        const auto at = static_cast<Eigen::Index>(p);
        if (parameter.kind == ParameterKind::kLogFlux)
          Add(s, {at, parameter.index, lumens[parameter.index]});
        else if (parameter.kind == ParameterKind::kAlbedo && !is_direct)
          AddSum(s, at, 2 * lamps + numbers, 1, columns.Of(p), groups);
        else if (parameter.kind == ParameterKind::kLuminaire)
          AddLuminaire(s, at, parameter, state, lamps, columns.Of(p), groups, lumens);
      }
    }
  }

  template <typename Row>
  void AddTo(int state, Eigen::Index receiver, double gain, Row&& row) const {
    for (const Term& term : terms_[static_cast<size_t>(state)])
      row[term.parameter] += gain * term.weight * static_cast<double>(columns_(receiver, term.column));
  }

 private:
  struct Term {
    Eigen::Index parameter = 0, column = 0;
    double weight = 0;
  };

  void Add(size_t state, const Term& term) {
    if (term.weight != 0) terms_[state].push_back(term);
  }

  void AddSum(size_t state, Eigen::Index p, Eigen::Index first, double factor,
              const std::vector<DerivativeColumns::Term>& sum, const Eigen::VectorXd& groups) {
    for (const DerivativeColumns::Term& term : sum)
      Add(state, {p, first + term.column, factor * groups[term.group]});
  }

  void AddLuminaire(size_t s, Eigen::Index p, const Parameter& parameter, const LightState& state,
                    Eigen::Index lamps, const std::vector<DerivativeColumns::Term>& sum,
                    const Eigen::VectorXd& groups, const Eigen::VectorXd& lumens) {
    const auto k = static_cast<size_t>(parameter.index);
    // The parameter is the exponent's logarithm.
    const bool is_exponent = parameter.quantity == LuminaireQuantity::kExponent;
    const double share = IsPart(parameter) ? ReferenceShare(state, parameter) : 1;
    AddSum(s, p, 2 * lamps, share * (is_exponent ? state.luminaires[k].cosine_exponent : 1), sum, groups);
    if (!IsPart(parameter)) return;
    // Light of the whole, reflected or not as that of its parts.
    Add(s, {p, lamps + parameter.index, -share * lumens[parameter.index]});
    for (const int j : parameter.tied) Add(s, {p, lamps + j, -share * lumens[j]});
  }

  // Holds side by side the light of luminaires, their light as that of parts is (reflected or not), and the derivatives by
  // their numbers and by reflectances.
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> columns_;
  std::vector<std::vector<Term>> terms_;  // by state
};

}  // namespace

LightModel::LightModel(const Room& room, const LightData& data)
    : room_(room),
      exchange_(room.clusters ? *room.clusters : room),
      data_(data),
      blocks_(RowBlocksOf(room, data)),
      groups_(GroupByDimming(data.dimming)) {
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
  if (data.indirect_is_held) return;
  if (room.clusters) of_patches_ = receivers_;
  PrepareGather(exchange_, receivers_);
  // It copies the receivers' rows of the form factors, which costs less than light at every element where they are few.
  if (of_patches_ && 2 * elements.size() < room.patches.elements.size()) PrepareGather(room_, *of_patches_);
}

void LightModel::FreezeVisibility(const LightState& state, int order) {
  visibility_ = (data_.indirect_is_held ? ComputeReceiverVisibility : ComputeVisibility)(
      room_, receivers_, state.luminaires, order);
  frozen_ = state.luminaires;
  frozen_order_ = order;
  FreezeReflected(state);
}

bool LightModel::RefreezeVisibility(const LightState& state, int order, double still_m) {
  if (frozen_.size() != state.luminaires.size() || frozen_order_ != order) {
    FreezeVisibility(state, order);
    return true;
  }
  std::vector<int> moved;
  for (size_t k = 0; k < frozen_.size(); ++k) {
    if (!(MoveOf(frozen_[k], state.luminaires[k]) > still_m)) continue;
    moved.push_back(static_cast<int>(k));
    frozen_[k] = state.luminaires[k];
  }
  if (!moved.empty()) UpdateVisibility(room_, receivers_, state.luminaires, order, moved, visibility_);
  const bool is_stale = IsReflectedStale(state, still_m);
  if (is_stale) FreezeReflected(state);
  return is_stale || !moved.empty();
}

bool LightModel::IsReflectedStale(const LightState& state, double still_m) const {
  if (!reflected_at_ || (reflected_at_->albedo - state.albedo).lpNorm<Eigen::Infinity>() > kStillAlbedo)
    return true;
  const std::vector<Luminaire>& before = reflected_at_->luminaires;
  for (size_t k = 0; k < before.size(); ++k) {
    if (!(MoveOf(before[k], state.luminaires[k]) <= still_m)) return true;
  }
  return false;
}

void LightModel::TakeOver(const FrozenLight& frozen) {
  if (!data_.indirect_is_held) channels_ = frozen.channels;
  const bool has_all = frozen.which.empty() && frozen.elements.size() > 0;
  if (!has_all && !(data_.indirect_is_held && frozen.which == receivers_.elements)) return;
  frozen_ = frozen.luminaires;
  frozen_order_ = frozen.order;
  reflected_at_.reset();
  if (!has_all) {
    visibility_.receivers = frozen.elements;
  } else if (data_.indirect_is_held) {
    visibility_.receivers = frozen.elements(receivers_.elements, Eigen::all);
  } else {
    visibility_.elements = frozen.elements;
    FillReceivers(room_, receivers_, frozen_, visibility_);
  }
}

FrozenLight LightModel::frozen() const {
  if (!data_.indirect_is_held) return {frozen_, frozen_order_, {}, visibility_.elements, channels_};
  return {frozen_, frozen_order_, receivers_.elements, visibility_.receivers, channels_};
}

void LightModel::FreezeReflected(const LightState& state) {
  hidden_.resize(0), reflected_.resize(0), colour_.resize(0);
  reflected_at_ = {state.luminaires, state.albedo};
  if (data_.indirect_is_held || room_.sparse) return;
  const bool departs = state.tint.size() > 0 || patch_factor_.size() > 0 || of_patches_;
  if (!departs && state.bodies == BodyPresence::kNone) return;
  if (departs && !(channels_ && channels_->Serve(state.albedo, state.tint, patch_factor_, kServedAlbedo)))
    channels_ =
        std::make_shared<ChannelTransports>(room_, exchange_, state.albedo, state.tint, patch_factor_);
  const Transport& grey_transport = departs ? channels_->grey() : TransportFor(state.albedo);
  std::vector<const Transport*> transports{&grey_transport}, of_patches;
  if (departs) {
    for (const Transport& channel : channels_->channels())
      (of_patches_ ? of_patches : transports).push_back(&channel);
  }
  std::vector<Eigen::MatrixXf> totals =
      ComputeTotals(exchange_, receivers_, visibility_, state.luminaires, transports);
  const Eigen::MatrixXf grey = std::move(totals.front());
  totals.erase(totals.begin());
  if (state.bodies != BodyPresence::kNone) FreezeBodies(state, grey_transport, grey);
  if (!departs) return;
  if (of_patches_) totals = ComputeTotals(room_, *of_patches_, visibility_, state.luminaires, of_patches);
  FreezeColour(state, grey, totals);
}

void LightModel::FreezeColour(const LightState& state, const Eigen::MatrixXf& grey,
                              const std::vector<Eigen::MatrixXf>& totals) {
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
    const double grey_lx = grey.row(row.receiver).cast<double>().dot(lumens);
    double sum_lx = 0;
    for (Eigen::Index c = 0; c < weights.size(); ++c)
      sum_lx += weights[c] * totals[static_cast<size_t>(c)].row(row.receiver).cast<double>().dot(lumens);
    if (grey_lx > 0) colour_[i] = sum_lx / grey_lx;
  }
}

void LightModel::FreezeBodies(const LightState& state, const Transport& transport,
                              const Eigen::MatrixXf& total) {
  const std::vector<CoveredSurface> surfaces = FindCoveredSurfaces(room_, state.luminaires);
  if (surfaces.empty()) return;
  const CoveredLight covered =
      ComputeCoveredLight(exchange_, receivers_, visibility_, state.luminaires, transport, surfaces);
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
      if (!(dimming[k] > min_dimming)) continue;
      const auto receiver = static_cast<size_t>(rows_[i].receiver);
      const float share = visibility_.receivers(rows_[i].receiver, k);
      if ((share > 0.001f && share < 0.999f) ||
          IsAtHorizonOf(frozen_[static_cast<size_t>(k)], receivers_.points[receiver],
                        min_dimming / dimming[k]))
        mixed[i] = true;
    }
  }
  return mixed;
}

Illuminance LightModel::Light(const LightState& state, const DerivativeRequest& request) const {
  if (data_.indirect_is_held)
    return ComputeDirectIlluminance(room_, receivers_, visibility_, state.luminaires, request);
  return ComputeIlluminance(exchange_, receivers_, visibility_, state.luminaires, TransportFor(state.albedo),
                            request);
}

std::vector<bool> LightModel::SizesThatOutlinesTell(const LightState& state,
                                                    const std::vector<Parameter>& parameters) const {
  std::vector<bool> is_told(parameters.size());
  if (data_.outlines.empty()) return is_told;
  for (size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& p = parameters[i];
    if (p.kind != ParameterKind::kLuminaire ||
        (p.quantity != LuminaireQuantity::kSizeAlong && p.quantity != LuminaireQuantity::kSizeAcross))
      continue;
    // A rectangle far longer than its outline is judged by its other sides alone: there the light has to bring it back.
    const std::vector<Parameter> size{p};
    Eigen::RowVectorXd derivative = Eigen::RowVectorXd::Zero(1);
    for (const auto& block : blocks_) {
      for (int row = 0; row < block->row_count() && derivative[0] == 0; ++row)
        block->AddOwnDerivatives(state, size, 0, row, derivative);
    }
    is_told[i] = derivative[0] != 0;
  }
  return is_told;
}

const Transport& LightModel::TransportFor(const Eigen::VectorXd& albedo) const {
  if (!transport_ || transport_->albedo() != albedo) transport_.emplace(exchange_.transport, albedo);
  return *transport_;
}

Prediction LightModel::Predict(const LightState& state, const std::vector<Parameter>& parameters,
                               bool with_jacobian) const {
  const std::vector<Parameter> asked = with_jacobian ? parameters : std::vector<Parameter>();
  const DerivativeColumns columns(state, asked, groups_, reflects_derivatives_,
                                  SizesThatOutlinesTell(state, asked));
  const Illuminance light = Light(state, columns.request());
  const ReceiverDerivative derivative(state, asked, light, columns, data_.dimming, groups_.dimming,
                                      data_.indirect_is_held);
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
    if (row.receiver < 0) {
      prediction.value[i] = response.offset;
      if (with_jacobian) block.AddOwnDerivatives(state, parameters, 0, row.place, prediction.jacobian.row(i));
      return;
    }
    const double unhidden_lx = light.total.row(row.receiver).cast<double>() * lumens;
    const double colour = colour_.size() > 0 ? colour_[i] : 1;
    const double left = colour * (hidden_.size() > 0 ? 1 - hidden_[i] + kBodyAlbedo * reflected_[i] : 1);
    const double illuminance_lx = left * unhidden_lx;
    if (hidden_.size() > 0) prediction.d_body[i] = response.gain * colour * unhidden_lx * reflected_[i];
    prediction.value[i] = response.gain * illuminance_lx + response.offset;
    prediction.direct[i] = response.gain * (light.direct.row(row.receiver).cast<double>() * lumens).value();
    if (!with_jacobian) return;
    derivative.AddTo(row.state, row.receiver, left * response.gain, prediction.jacobian.row(i));
    block.AddOwnDerivatives(state, parameters, illuminance_lx, row.place, prediction.jacobian.row(i));
  });
  return prediction;
}

RowMajorMatrix LightModel::LightReflectedBy(const LightState& state,
                                            const std::vector<CoveredSurface>& surfaces) const {
  const CoveredLight light = ComputeCoveredLight(exchange_, receivers_, visibility_, state.luminaires,
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
