#include "apps/stages/parameter_json.h"

#include <nlohmann/json.hpp>
#include <string>

namespace luxfit {
namespace {

using nlohmann::json;

// Returns the key of the owner; empty where nothing owns the parameter.
std::string OwnerKey(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kLuminaire:
    case ParameterKind::kLogFlux:
      return "luminaire";
    case ParameterKind::kAlbedo:
      return "material";
    case ParameterKind::kLogSensorGain:
      return "sensor";
    case ParameterKind::kAmbientShare:
      return "state";
    case ParameterKind::kLogCameraScale:
    case ParameterKind::kLogMeterScale:
      return "";
  }
  return "";
}

template <typename Word>
Word Known(const std::optional<Word>& word, const json& entry) {
  if (!word) throw json::other_error::create(501, "unknown parameter " + entry.dump(), &entry);
  return *word;
}

}  // namespace

json IdJson(const ParameterId& id) {
  json entry = {{"kind", ToString(id.kind)}};
  const std::string owner = OwnerKey(id.kind);
  if (!owner.empty()) entry[owner] = id.owner;
  if (id.kind != ParameterKind::kLuminaire) return entry;
  entry["quantity"] = ToString(id.quantity);
  if (HasParts(id.quantity)) entry["part"] = id.part;
  return entry;
}

ParameterId IdFromJson(const json& entry) {
  ParameterId id;
  id.kind = Known(ParameterKindFrom(entry.at("kind")), entry);
  const std::string owner = OwnerKey(id.kind);
  if (!owner.empty()) id.owner = entry.at(owner);
  if (id.kind != ParameterKind::kLuminaire) return id;
  id.quantity = Known(LuminaireQuantityFrom(entry.at("quantity")), entry);
  if (HasParts(id.quantity)) id.part = entry.at("part");
  return id;
}

}  // namespace luxfit
