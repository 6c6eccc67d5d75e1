#include "inverse/model/light_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "forward/luminaire/luminaire_parts.h"

namespace luxfit {
namespace {

PartKind PartKindOf(LuminaireQuantity quantity) {
  return quantity == LuminaireQuantity::kCell ? PartKind::kCell : PartKind::kGammaNode;
}

bool IsPart(const Parameter& p) {
  return p.kind == ParameterKind::kLuminaire &&
         (p.quantity == LuminaireQuantity::kCell || p.quantity == LuminaireQuantity::kGammaNode);
}

AimFrame FrameOf(const Luminaire& luminaire) {
  const LuminaireAxes axes = AxesOf(luminaire);
  return {luminaire.aim, axes.along, axes.across};
}

bool IsTurn(const Parameter& p) {
  return p.kind == ParameterKind::kLuminaire &&
         (p.quantity == LuminaireQuantity::kTiltAlong || p.quantity == LuminaireQuantity::kTiltAcross ||
          p.quantity == LuminaireQuantity::kHeading);
}

// A luminaire's turn from a frame: first about the aim by `heading`, then the aim by `tilt` along the turned axes.
//   along_h = cos(h) along + sin(h) across,   aim' ~ aim + t1 along_h + t2 across_h
struct Turn {
  AimFrame frame;
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();
  double heading = 0;

  Eigen::Vector3d Along() const { return std::cos(heading) * frame.along + std::sin(heading) * frame.across; }
};

void Apply(const Turn& turn, Luminaire& luminaire) {
  const Eigen::Vector3d along = turn.Along(), across = turn.frame.aim.cross(along);
  luminaire.aim = (turn.frame.aim + turn.tilt[0] * along + turn.tilt[1] * across).normalized();
  luminaire.heading = along;
  luminaire.heading = AxesOf(luminaire).along;
}

// The inverse: along_h is the vector across the frame's aim that the heading is the projection of.
Turn TurnOf(const Luminaire& luminaire, const AimFrame& frame) {
  Turn turn{frame};
  const Eigen::Vector3d& heading = AxesOf(luminaire).along;
  const double cosine = luminaire.aim.dot(frame.aim);
  const Eigen::Vector3d along = heading - heading.dot(frame.aim) / cosine * luminaire.aim;
  turn.heading = std::atan2(along.dot(frame.across), along.dot(frame.along));
  const Eigen::Vector3d unit = turn.Along();
  turn.tilt = Eigen::Vector2d(luminaire.aim.dot(unit), luminaire.aim.dot(frame.aim.cross(unit))) / cosine;
  return turn;
}

double& SizeComponent(Luminaire& luminaire, LuminaireQuantity quantity) {
  return luminaire.size_m[quantity == LuminaireQuantity::kSizeAlong ? 0 : 1];
}

std::vector<LuminaireQuantity> FreeQuantitiesOf(const Luminaire& luminaire, const FreeQuantities& free) {
  std::vector<LuminaireQuantity> list;
  if (free.position) {
    list.insert(list.end(), {LuminaireQuantity::kPositionX, LuminaireQuantity::kPositionY,
                             LuminaireQuantity::kPositionZ});
  }
  if (free.exponent && luminaire.distribution == Distribution::kCosinePower) {
    list.push_back(LuminaireQuantity::kExponent);
  }
  if (free.size && luminaire.shape != LuminaireShape::kPoint) {
    list.push_back(LuminaireQuantity::kSizeAlong);
    if (luminaire.shape == LuminaireShape::kRectangle) list.push_back(LuminaireQuantity::kSizeAcross);
  }
  if (free.tilt) list.insert(list.end(), {LuminaireQuantity::kTiltAlong, LuminaireQuantity::kTiltAcross});
  if (free.heading) list.push_back(LuminaireQuantity::kHeading);
  return list;
}

Parameter MakeLuminaireParameter(const Eigen::AlignedBox3d& box, const Luminaire& luminaire, int index,
                                 LuminaireQuantity quantity) {
  Parameter p{ParameterKind::kLuminaire, index, quantity, 0, 0, luminaire.id};
  p.frame = FrameOf(luminaire);
  constexpr double kClearanceM = 1e-3;  // from the walls: a luminaire has a thickness
  switch (quantity) {
    case LuminaireQuantity::kPositionX:
    case LuminaireQuantity::kPositionY:
    case LuminaireQuantity::kPositionZ: {
      const int axis = static_cast<int>(quantity);
      p.lower = box.isEmpty() ? -1e3 : box.min()[axis] + kClearanceM;
      p.upper = box.isEmpty() ? 1e3 : box.max()[axis] - kClearanceM;
      break;
    }
    case LuminaireQuantity::kExponent:
      p.lower = std::log(0.2), p.upper = std::log(100);
      break;
    case LuminaireQuantity::kSizeAlong:
    case LuminaireQuantity::kSizeAcross:
      p.lower = 1e-3;
      p.upper = box.isEmpty() ? 10 : 0.5 * box.diagonal().maxCoeff();
      break;
    case LuminaireQuantity::kTiltAlong:
    case LuminaireQuantity::kTiltAcross:
      p.lower = -1, p.upper = 1;
      break;
    case LuminaireQuantity::kHeading:
      p.lower = -M_PI, p.upper = M_PI;
      break;
    case LuminaireQuantity::kGammaNode:
    case LuminaireQuantity::kCell:
      p.upper = 1e3;
      break;
  }
  return p;
}

// Of a quantity that is no part.
double ValueOf(const Luminaire& luminaire, const Parameter& p) {
  switch (p.quantity) {
    case LuminaireQuantity::kPositionX:
    case LuminaireQuantity::kPositionY:
    case LuminaireQuantity::kPositionZ:
      return luminaire.position[static_cast<int>(p.quantity)];
    case LuminaireQuantity::kExponent:
      return std::log(luminaire.cosine_exponent);
    case LuminaireQuantity::kSizeAlong:
      return luminaire.size_m[0];
    case LuminaireQuantity::kSizeAcross:
      return luminaire.size_m[1];
    case LuminaireQuantity::kTiltAlong:
      return TurnOf(luminaire, p.frame).tilt[0];
    case LuminaireQuantity::kTiltAcross:
      return TurnOf(luminaire, p.frame).tilt[1];
    case LuminaireQuantity::kHeading:
      return TurnOf(luminaire, p.frame).heading;
    case LuminaireQuantity::kGammaNode:
    case LuminaireQuantity::kCell:
      break;
  }
  return 0;
}

void AddParts(const Eigen::AlignedBox3d& box, const Luminaire& luminaire, int index,
              LuminaireQuantity quantity, std::vector<Parameter>& parameters) {
  const Eigen::VectorXd shares = PartShares(luminaire, PartKindOf(quantity));
  if (shares.size() == 0) return;
  int reference = 0;
  shares.maxCoeff(&reference);
  for (int j = 0; j < static_cast<int>(shares.size()); ++j) {
    if (j == reference) continue;
    Parameter p = MakeLuminaireParameter(box, luminaire, index, quantity);
    p.part = j, p.reference = reference;
    parameters.push_back(std::move(p));
  }
}

}  // namespace

std::vector<Parameter> FreeParameters(const Room& room, const LightState& state) {
  std::vector<Parameter> parameters;
  const Eigen::AlignedBox3d box = room.scene.Bounds();
  for (size_t k = 0; k < state.luminaires.size(); ++k) {
    const Luminaire& luminaire = state.luminaires[k];
    for (const LuminaireQuantity quantity : FreeQuantitiesOf(luminaire, state.free[k])) {
      parameters.push_back(MakeLuminaireParameter(box, luminaire, static_cast<int>(k), quantity));
    }
    const int index = static_cast<int>(k);
    if (state.free[k].table_sigma > 0)
      AddParts(box, luminaire, index, LuminaireQuantity::kGammaNode, parameters);
    if (state.free[k].emission_sigma > 0)
      AddParts(box, luminaire, index, LuminaireQuantity::kCell, parameters);
    if (state.free[k].flux) {
      parameters.push_back({ParameterKind::kLogFlux, static_cast<int>(k), {}, -50, 50, luminaire.id});
    }
  }
  for (size_t m = 0; m < state.albedo_free.size(); ++m) {
    if (!state.albedo_free[m]) continue;
    parameters.push_back(
        {ParameterKind::kAlbedo, static_cast<int>(m), {}, 0.01, 0.98, room.scene.materials[m]});
  }
  if (state.camera_scale_free) {
    parameters.push_back({ParameterKind::kLogCameraScale, 0, {}, -50, 50, ""});
  }
  if (state.meter_scale_free) parameters.push_back({ParameterKind::kLogMeterScale, 0, {}, -1, 1, ""});
  for (int i = 0; state.sensor_gains_free && i < static_cast<int>(state.sensor_gain.size()); ++i) {
    parameters.push_back({ParameterKind::kLogSensorGain, i, {}, -1, 1, std::to_string(i)});
  }
  return parameters;
}

Eigen::VectorXd PackParameters(const LightState& state, const std::vector<Parameter>& parameters) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(parameters.size()));
  for (size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& p = parameters[i];
    const size_t index = static_cast<size_t>(p.index);
    double value = 0;
    if (p.kind == ParameterKind::kLogFlux) value = std::log(state.luminaires[index].flux_lm);
    if (p.kind == ParameterKind::kAlbedo) value = state.albedo[p.index];
    if (p.kind == ParameterKind::kLogCameraScale) value = std::log(state.camera_scale);
    if (p.kind == ParameterKind::kLogMeterScale) value = std::log(state.meter_scale);
    if (p.kind == ParameterKind::kLogSensorGain) value = std::log(state.sensor_gain[p.index]);
    if (IsPart(p)) {
      const Eigen::VectorXd shares = PartShares(state.luminaires[index], PartKindOf(p.quantity));
      value = shares[p.part] / shares[p.reference];
    } else if (p.kind == ParameterKind::kLuminaire) {
      value = ValueOf(state.luminaires[index], p);
    }
    x[static_cast<Eigen::Index>(i)] = std::clamp(value, p.lower, p.upper);
  }
  return x;
}

LightState WithParameters(LightState state, const std::vector<Parameter>& parameters,
                          const Eigen::VectorXd& x) {
  std::map<int, Turn> turns;
  std::map<std::pair<int, LuminaireQuantity>, Eigen::VectorXd> parts;
  for (size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& p = parameters[i];
    const size_t index = static_cast<size_t>(p.index);
    const double value = x[static_cast<Eigen::Index>(i)];
    if (p.kind == ParameterKind::kLogFlux) state.luminaires[index].flux_lm = std::exp(value);
    if (p.kind == ParameterKind::kAlbedo) state.albedo[p.index] = value;
    if (p.kind == ParameterKind::kLogCameraScale) state.camera_scale = std::exp(value);
    if (p.kind == ParameterKind::kLogMeterScale) state.meter_scale = std::exp(value);
    if (p.kind == ParameterKind::kLogSensorGain) state.sensor_gain[p.index] = std::exp(value);
    if (p.kind != ParameterKind::kLuminaire) continue;
    Luminaire& luminaire = state.luminaires[index];
    if (IsPart(p)) {
      Eigen::VectorXd& shares = parts[{p.index, p.quantity}];
      if (shares.size() == 0) {
        shares = PartShares(luminaire, PartKindOf(p.quantity));
        shares /= shares[p.reference];
      }
      shares[p.part] = value;
      continue;
    }
    switch (p.quantity) {
      case LuminaireQuantity::kPositionX:
      case LuminaireQuantity::kPositionY:
      case LuminaireQuantity::kPositionZ:
        luminaire.position[static_cast<int>(p.quantity)] = value;
        break;
      case LuminaireQuantity::kExponent:
        luminaire.cosine_exponent = std::exp(value);
        break;
      case LuminaireQuantity::kSizeAlong:
      case LuminaireQuantity::kSizeAcross:
        SizeComponent(luminaire, p.quantity) = value;
        break;
      case LuminaireQuantity::kTiltAlong:
        turns.try_emplace(p.index, Turn{p.frame}).first->second.tilt[0] = value;
        break;
      case LuminaireQuantity::kTiltAcross:
        turns.try_emplace(p.index, Turn{p.frame}).first->second.tilt[1] = value;
        break;
      case LuminaireQuantity::kHeading:
        turns.try_emplace(p.index, Turn{p.frame}).first->second.heading = value;
        break;
      case LuminaireQuantity::kGammaNode:
      case LuminaireQuantity::kCell:
        break;  // above
    }
  }
  for (const auto& [of, shares] : parts) {
    Luminaire& luminaire = state.luminaires[static_cast<size_t>(of.first)];
    luminaire = WithPartShares(luminaire, PartKindOf(of.second), shares);
  }
  for (const auto& [index, turn] : turns) Apply(turn, state.luminaires[static_cast<size_t>(index)]);
  return state;
}

std::vector<Parameter> Recentred(std::vector<Parameter> parameters, const LightState& state) {
  for (Parameter& p : parameters)
    if (IsTurn(p)) p.frame = FrameOf(state.luminaires[static_cast<size_t>(p.index)]);
  return parameters;
}

LightModel::LightModel(const Room& room, const LightData& data) : room_(room), data_(data) {
  if (data.indirect_is_held && !data.readings.empty())
    throw std::invalid_argument("LightModel: expected no readings where the indirect light was measured");
  std::vector<int> elements;
  for (const Observation& o : data.observations) {
    if (o.element < 0 || o.element >= static_cast<int>(room.patches.elements.size())) {
      throw std::invalid_argument("LightModel: expected an element index below " +
                                  std::to_string(room.patches.elements.size()));
    }
    elements.push_back(o.element);
  }
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  std::vector<Sensor> sensors;
  for (const Observation& o : data.observations) {
    const auto place = std::lower_bound(elements.begin(), elements.end(), o.element);
    receiver_of_row_.push_back(static_cast<int>(place - elements.begin()));
    state_of_row_.push_back(o.state);
    const int patch = room.patches.elements[static_cast<size_t>(o.element)].patch;
    material_of_row_.push_back(room.patches.patches[static_cast<size_t>(patch)].material);
  }
  for (const Reading& reading : data.readings) {
    // A point read in several states is one sensor.
    size_t s = 0;
    while (s < sensors.size() && !(sensors[s] == reading.sensor)) {
      ++s;
    }
    if (s == sensors.size()) sensors.push_back(reading.sensor);
    receiver_of_row_.push_back(static_cast<int>(elements.size() + s));
    state_of_row_.push_back(reading.state);
    material_of_row_.push_back(-1);
  }
  for (const int s : state_of_row_) {
    if (s < 0 || s >= static_cast<int>(data.dimming.size())) {
      throw std::invalid_argument("LightModel: expected a state index below " +
                                  std::to_string(data.dimming.size()));
    }
  }
  receivers_ = MakeReceivers(room, elements, sensors);
  if (!data.indirect_is_held) PrepareGather(room, receivers_);
}

void LightModel::FreezeVisibility(const LightState& state, int order) {
  visibility_ = (data_.indirect_is_held ? ComputeReceiverVisibility : ComputeVisibility)(
      room_, receivers_, state.luminaires, order);
}

std::vector<bool> LightModel::InPenumbra(double min_dimming) const {
  std::vector<bool> mixed(data_.observations.size());
  for (size_t i = 0; i < mixed.size(); ++i) {
    const Eigen::VectorXd& dimming = data_.dimming[static_cast<size_t>(state_of_row_[i])];
    for (Eigen::Index k = 0; k < dimming.size(); ++k) {
      const float share = visibility_.receivers(receiver_of_row_[i], k);
      if (dimming[k] > min_dimming && share > 0.001f && share < 0.999f) mixed[i] = true;
    }
  }
  return mixed;
}

Illuminance LightModel::Light(const LightState& state, const DerivativeRequest& request) const {
  if (data_.indirect_is_held)
    return ComputeDirectIlluminance(room_, receivers_, visibility_, state.luminaires, request);
  if (!transport_ || transport_->albedo() != state.albedo) transport_.emplace(room_.transport, state.albedo);
  return ComputeIlluminance(room_, receivers_, visibility_, state.luminaires, *transport_, request);
}

Prediction LightModel::Predict(const LightState& state, const std::vector<Parameter>& parameters,
                               bool with_jacobian) const {
  DerivativeRequest request;
  std::vector<int> column_of_parameter(parameters.size(), -1);
  if (with_jacobian) {
    for (size_t i = 0; i < parameters.size(); ++i) {
      const Parameter& p = parameters[i];
      if (p.kind == ParameterKind::kLuminaire) {
        column_of_parameter[i] = static_cast<int>(request.parameters.size());
        request.parameters.push_back({p.index, p.quantity, p.part});
      } else if (p.kind == ParameterKind::kAlbedo) {
        column_of_parameter[i] = static_cast<int>(request.materials.size());
        request.materials.push_back(p.index);
      }
    }
  }
  const Illuminance light = Light(state, request);
  const Eigen::Index lamps = static_cast<Eigen::Index>(state.luminaires.size());
  const Eigen::Index materials = static_cast<Eigen::Index>(request.materials.size());
  Eigen::VectorXd flux(lamps);
  for (Eigen::Index k = 0; k < lamps; ++k) flux[k] = state.luminaires[static_cast<size_t>(k)].flux_lm;

  // Of part parameters: the share of the reference, by which the others are counted.
  std::vector<double> reference_share(parameters.size(), 0.0);
  for (size_t p = 0; with_jacobian && p < parameters.size(); ++p) {
    const Parameter& of = parameters[p];
    if (IsPart(of))
      reference_share[p] =
          PartShares(state.luminaires[static_cast<size_t>(of.index)], PartKindOf(of.quantity))[of.reference];
  }

  Prediction prediction;
  prediction.value.resize(row_count());
  prediction.reading_direct_lx.resize(static_cast<Eigen::Index>(data_.readings.size()));
  if (with_jacobian) prediction.jacobian.setZero(row_count(), static_cast<Eigen::Index>(parameters.size()));
  const int observations = static_cast<int>(data_.observations.size());
  tbb::parallel_for(0, row_count(), [&](int i) {
    const size_t row = static_cast<size_t>(i);
    const Eigen::Index r = receiver_of_row_[row];
    const Eigen::VectorXd lumens = data_.dimming[static_cast<size_t>(state_of_row_[row])].cwiseProduct(flux);
    const int material = material_of_row_[row];
    // What turns illuminance into the row's own unit.
    const int sensor = i < observations ? -1 : data_.readings[row - data_.observations.size()].sensor_index;
    const double sensor_gain = sensor >= 0 && state.sensor_gain.size() > 0 ? state.sensor_gain[sensor] : 1;
    const double unit = material < 0 ? state.meter_scale * sensor_gain : state.camera_scale / M_PI;
    const double gain = material < 0 ? unit : unit * state.albedo[material];
    const double illuminance = light.total.row(r).cast<double>() * lumens;
    // Of a white surface, in the row's own unit.
    const double white =
        unit * illuminance + (data_.indirect_is_held ? data_.observations[row].relative_indirect : 0.0);
    prediction.value[i] = material < 0 ? white : state.albedo[material] * white;
    if (i >= observations) {
      const double direct = light.direct.row(r).cast<double>() * lumens;
      prediction.reading_direct_lx[i - observations] = gain * direct;
    }
    for (size_t p = 0; with_jacobian && p < parameters.size(); ++p) {
      const Parameter& parameter = parameters[p];
      const Eigen::Index k = parameter.index;
      double& out = prediction.jacobian(i, static_cast<Eigen::Index>(p));
      if (parameter.kind == ParameterKind::kLogFlux) {
        out = gain * lumens[k] * light.total(r, k);
      } else if (parameter.kind == ParameterKind::kLogCameraScale) {
        out = material < 0 ? 0.0 : gain * illuminance;
      } else if (parameter.kind == ParameterKind::kLogMeterScale) {
        out = material < 0 ? gain * illuminance : 0.0;
      } else if (parameter.kind == ParameterKind::kLogSensorGain) {
        out = sensor == parameter.index ? gain * illuminance : 0.0;
      } else if (IsPart(parameter)) {
        const double part = static_cast<double>(light.d_luminaire(r, column_of_parameter[p]));
        out = gain * lumens[k] * reference_share[p] * (part - static_cast<double>(light.total(r, k)));
      } else if (parameter.kind == ParameterKind::kAlbedo) {
        double sum = 0;
        for (Eigen::Index j = 0; j < lamps && !data_.indirect_is_held; ++j) {
          sum += lumens[j] * light.d_albedo(r, j * materials + column_of_parameter[p]);
        }
        out = gain * sum + (material == parameter.index ? white : 0.0);
      } else {
        out = gain * lumens[k] * light.d_luminaire(r, column_of_parameter[p]);
        if (parameter.quantity == LuminaireQuantity::kExponent) {
          out *= state.luminaires[static_cast<size_t>(k)].cosine_exponent;
        }
      }
    }
  });
  return prediction;
}

}  // namespace luxfit
