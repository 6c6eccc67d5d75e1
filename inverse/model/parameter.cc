#include "inverse/model/parameter.h"

#include <array>
#include <utility>

namespace luxfit {
namespace {

struct KindWords {
  ParameterKind kind;
  const char* in_files;
  const char* for_people;
};
constexpr std::array<KindWords, 7> kKinds{
    {{ParameterKind::kLuminaire, "luminaire", ""},
     {ParameterKind::kLogFlux, "log_flux", "log flux"},
     {ParameterKind::kAlbedo, "albedo", "albedo"},
     {ParameterKind::kLogCameraScale, "log_camera_scale", "log camera scale"},
     {ParameterKind::kLogMeterScale, "log_meter_scale", "log meter scale"},
     {ParameterKind::kLogSensorGain, "log_sensor_gain", "log gain"},
     {ParameterKind::kAmbientShare, "ambient_share", "share of ambient light"}}};

struct QuantityWords {
  LuminaireQuantity quantity;
  const char* in_files;
  const char* for_people;
};
constexpr std::array<QuantityWords, 12> kQuantities{
    {{LuminaireQuantity::kPositionX, "position_x", "position x"},
     {LuminaireQuantity::kPositionY, "position_y", "position y"},
     {LuminaireQuantity::kPositionZ, "position_z", "position z"},
     {LuminaireQuantity::kExponent, "log_exponent", "log exponent"},
     {LuminaireQuantity::kSizeAlong, "size_along", "size along"},
     {LuminaireQuantity::kSizeAcross, "size_across", "size across"},
     {LuminaireQuantity::kTiltAlong, "tilt_along", "tilt along"},
     {LuminaireQuantity::kTiltAcross, "tilt_across", "tilt across"},
     {LuminaireQuantity::kHeading, "heading", "heading"},
     {LuminaireQuantity::kGammaNode, "gamma_node", "gamma node"},
     {LuminaireQuantity::kCell, "cell", "cell"},
     {LuminaireQuantity::kSide, "side", "side"}}};

const KindWords& WordsOf(ParameterKind kind) { return kKinds[static_cast<size_t>(kind)]; }
const QuantityWords& WordsOf(LuminaireQuantity quantity) {
  return kQuantities[static_cast<size_t>(quantity)];
}

}  // namespace

bool HasParts(LuminaireQuantity quantity) {
  return quantity == LuminaireQuantity::kGammaNode || quantity == LuminaireQuantity::kCell ||
         quantity == LuminaireQuantity::kSide;
}

bool operator==(const ParameterId& a, const ParameterId& b) {
  if (a.kind != b.kind || a.owner != b.owner) return false;
  if (a.kind != ParameterKind::kLuminaire) return true;
  return a.quantity == b.quantity && (!HasParts(a.quantity) || a.part == b.part);
}

bool operator!=(const ParameterId& a, const ParameterId& b) { return !(a == b); }

std::string NameOf(const ParameterId& id) {
  std::string name = WordsOf(id.kind).for_people;
  if (id.kind == ParameterKind::kLuminaire) {
    name = WordsOf(id.quantity).for_people;
    if (HasParts(id.quantity)) name += " " + std::to_string(id.part);
  }
  if (id.kind == ParameterKind::kLogSensorGain) return name + " of sensor " + id.owner;
  if (id.kind == ParameterKind::kAmbientShare) return name + " in state " + id.owner;
  return id.owner.empty() ? name : name + " of " + id.owner;
}

std::vector<std::string> NamesOf(const std::vector<ParameterId>& ids) {
  std::vector<std::string> names;
  names.reserve(ids.size());
  for (const ParameterId& id : ids) names.push_back(NameOf(id));
  return names;
}

std::string ToString(ParameterKind kind) { return WordsOf(kind).in_files; }

std::optional<ParameterKind> ParameterKindFrom(const std::string& word) {
  for (const KindWords& words : kKinds)
    if (word == words.in_files) return words.kind;
  return std::nullopt;
}

std::string ToString(LuminaireQuantity quantity) { return WordsOf(quantity).in_files; }

std::optional<LuminaireQuantity> LuminaireQuantityFrom(const std::string& word) {
  for (const QuantityWords& words : kQuantities)
    if (word == words.in_files) return words.quantity;
  return std::nullopt;
}

}  // namespace luxfit
