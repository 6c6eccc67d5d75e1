#include "inverse/model/light_state.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "forward/luminaire/distribution_ops.h"
#include "forward/luminaire/luminaire_parts.h"

namespace luxfit {
namespace {

PartKind PartKindOf(LuminaireQuantity quantity) {
  if (quantity == LuminaireQuantity::kSide) return PartKind::kSide;
  return quantity == LuminaireQuantity::kCell ? PartKind::kCell : PartKind::kGammaNode;
}

AimFrame FrameOf(const Luminaire& luminaire) {
  const LuminaireAxes axes = AxesOf(luminaire);
  return {luminaire.aim, axes.along, axes.across};
}

bool IsPosition(LuminaireQuantity quantity) {
  return quantity == LuminaireQuantity::kPositionX || quantity == LuminaireQuantity::kPositionY ||
         quantity == LuminaireQuantity::kPositionZ;
}

bool IsTurn(const Parameter& p) {
  return p.kind == ParameterKind::kLuminaire &&
         (p.quantity == LuminaireQuantity::kTiltAlong || p.quantity == LuminaireQuantity::kTiltAcross ||
          p.quantity == LuminaireQuantity::kHeading);
}

// Holds a luminaire's turn from a frame: about the aim by `heading`, then the aim by `tilt` along the turned
// axes.
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

// Inverts Turn. along_h is the vector across the frame's aim whose projection is the heading.
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
  if (free.exponent && OpsOf(luminaire.distribution).has_exponent) {
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
      p.lower = std::log(kLeastCosinePower), p.upper = std::log(kGreatestCosinePower);
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
    case LuminaireQuantity::kSide:
      p.lower = 1e-3;  // a side without light would have lost its shape
      p.upper = 1e3;
      break;
  }
  return p;
}

// Returns the value of a quantity that is not a part.
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
    case LuminaireQuantity::kSide:
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

std::vector<int> OthersOfType(const LightState& state, int first) {
  std::vector<int> others;
  for (int k = 0; k < static_cast<int>(state.first_of_type.size()); ++k) {
    if (k != first && state.first_of_type[static_cast<size_t>(k)] == first) others.push_back(k);
  }
  return others;
}

void AddLuminaire(const Eigen::AlignedBox3d& box, const LightState& state, int index,
                  std::vector<Parameter>& parameters) {
  const Luminaire& luminaire = state.luminaires[static_cast<size_t>(index)];
  const FreeQuantities& free = state.free[static_cast<size_t>(index)];
  const size_t before = parameters.size();
  for (const LuminaireQuantity quantity : FreeQuantitiesOf(luminaire, free))
    parameters.push_back(MakeLuminaireParameter(box, luminaire, index, quantity));
  if (free.table_sigma > 0) AddParts(box, luminaire, index, LuminaireQuantity::kGammaNode, parameters);
  if (free.sides) AddParts(box, luminaire, index, LuminaireQuantity::kSide, parameters);
  if (free.emission_sigma > 0) AddParts(box, luminaire, index, LuminaireQuantity::kCell, parameters);
  const auto own = parameters.begin() + static_cast<std::ptrdiff_t>(before);
  const auto is_tied = [&](const Parameter& p) {
    return !IsPosition(p.quantity) && !(free.own_direction && IsTurn(p));
  };
  if (IsFirstOfType(state, index)) {
    const std::vector<int> others = OthersOfType(state, index);
    std::for_each(own, parameters.end(), [&](Parameter& p) {
      if (is_tied(p)) p.tied = others;
    });
  } else {
    parameters.erase(std::remove_if(own, parameters.end(), is_tied), parameters.end());
  }
  if (free.flux) parameters.push_back({ParameterKind::kLogFlux, index, {}, -50, 50, luminaire.id});
}

}  // namespace

double MoveOf(const Luminaire& from, const Luminaire& to) {
  if (from.shape != to.shape) return std::numeric_limits<double>::infinity();
  const double turn = (from.aim - to.aim).norm() * 0.5 * from.size_m.maxCoeff();
  const double growth = 0.5 * (from.size_m - to.size_m).cwiseAbs().maxCoeff();
  return (from.position - to.position).norm() + turn + growth;
}

bool IsFirstOfType(const LightState& state, int luminaire) {
  return state.first_of_type.empty() || state.first_of_type[static_cast<size_t>(luminaire)] == luminaire;
}

Eigen::MatrixXf LumensByState(const LightData& data, const std::vector<Luminaire>& luminaires) {
  const Eigen::VectorXd flux_lm = FluxesLm(luminaires);
  Eigen::MatrixXf lumens(flux_lm.size(), static_cast<Eigen::Index>(data.dimming.size()));
  for (Eigen::Index s = 0; s < lumens.cols(); ++s)
    lumens.col(s) = data.dimming[static_cast<size_t>(s)].cwiseProduct(flux_lm).cast<float>();
  return lumens;
}

bool IsPart(const Parameter& p) { return p.kind == ParameterKind::kLuminaire && HasParts(p.quantity); }

double ReferenceShare(const LightState& state, const Parameter& p) {
  return PartShares(state.luminaires[static_cast<size_t>(p.index)], PartKindOf(p.quantity))[p.reference];
}

std::vector<std::vector<int>> TypesOf(const LightState& state) {
  std::vector<std::vector<int>> types;
  for (int k = 0; k < static_cast<int>(state.luminaires.size()); ++k) {
    if (!IsFirstOfType(state, k)) continue;
    types.push_back({k});
    const std::vector<int> others = OthersOfType(state, k);
    types.back().insert(types.back().end(), others.begin(), others.end());
  }
  return types;
}

Luminaire OfTypeOf(const Luminaire& first, const Luminaire& luminaire, bool has_own_direction) {
  Luminaire alike = first;
  alike.id = luminaire.id;
  alike.position = luminaire.position;
  alike.flux_lm = luminaire.flux_lm;
  if (has_own_direction) alike.aim = luminaire.aim, alike.heading = luminaire.heading;
  return alike;
}

LightState WithLikeTypes(LightState state) {
  for (size_t k = 0; k < state.first_of_type.size(); ++k) {
    const auto first = static_cast<size_t>(state.first_of_type[k]);
    if (first == k) continue;
    const FreeQuantities own = state.free[k];
    state.free[k] = state.free[first];
    state.free[k].position = own.position;
    state.free[k].flux = own.flux;
    if (own.own_direction) state.free[k].tilt = own.tilt, state.free[k].heading = own.heading;
    state.luminaires[k] = OfTypeOf(state.luminaires[first], state.luminaires[k], own.own_direction);
  }
  return state;
}

std::vector<Parameter> FreeParameters(const Room& room, const LightState& state) {
  std::vector<Parameter> parameters;
  const Eigen::AlignedBox3d box = room.scene.Bounds();
  for (size_t k = 0; k < state.luminaires.size(); ++k)
    AddLuminaire(box, state, static_cast<int>(k), parameters);
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
  for (int s = 0; state.ambient_shares_free && s < static_cast<int>(state.ambient_share.size()); ++s)
    parameters.push_back({ParameterKind::kAmbientShare, s, {}, -1, 1, std::to_string(s)});
  return parameters;
}

std::string ToString(BodyPresence bodies) {
  if (bodies == BodyPresence::kNone) return "none";
  return bodies == BodyPresence::kWhenOn ? "when_on" : "always";
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
    if (p.kind == ParameterKind::kAmbientShare) value = state.ambient_share[p.index];
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
    if (p.kind == ParameterKind::kAmbientShare) state.ambient_share[p.index] = value;
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
      case LuminaireQuantity::kSide:
      case LuminaireQuantity::kCell:
        break;  // above
    }
  }
  for (const auto& [of, shares] : parts) {
    Luminaire& luminaire = state.luminaires[static_cast<size_t>(of.first)];
    luminaire = WithPartShares(luminaire, PartKindOf(of.second), shares);
  }
  for (const auto& [index, turn] : turns) Apply(turn, state.luminaires[static_cast<size_t>(index)]);
  for (size_t k = 0; k < state.first_of_type.size(); ++k) {
    const auto first = static_cast<size_t>(state.first_of_type[k]);
    if (first != k)
      state.luminaires[k] =
          OfTypeOf(state.luminaires[first], state.luminaires[k], state.free[k].own_direction);
  }
  return state;
}

std::vector<Parameter> Recentred(std::vector<Parameter> parameters, const LightState& state) {
  for (Parameter& p : parameters)
    if (IsTurn(p)) p.frame = FrameOf(state.luminaires[static_cast<size_t>(p.index)]);
  return parameters;
}

}  // namespace luxfit
