#include "apps/text/formats/former_keys.h"

#include <nlohmann/json.hpp>
#include <string>

namespace luxfit {
namespace {

using nlohmann::json;

void AddAliases(json& values, const std::string& from, const std::string& to) {
  if (values.is_object()) {
    json aliases = json::object();
    for (const auto& [key, value] : values.items()) {
      if (key.size() <= from.size() || key.compare(key.size() - from.size(), from.size(), from) != 0)
        continue;
      const std::string alias = key.substr(0, key.size() - from.size()) + to;
      if (!values.contains(alias)) aliases[alias] = value;
    }
    values.update(aliases);
  }
  for (json& value : values) {
    if (value.is_structured()) AddAliases(value, from, to);
  }
}

}  // namespace

void AddFormerKeys(json& values) { AddAliases(values, "_lx", "_lux"); }

void AddPresentKeys(json& values) { AddAliases(values, "_lux", "_lx"); }

}  // namespace luxfit
