#include "apps/text/formats/former_keys.h"

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace luxfit {
namespace {

using nlohmann::json;

// Present and former names of whole keys.
constexpr std::array<std::pair<const char*, const char*>, 2> kRenamed = {
    {{"fix", "mend"}, {"relative_sigma_prior", "relative_sigma_beforehand"}}};

// Returns the key with another ending; "" where it ends otherwise.
std::string WithEnding(const std::string& key, const std::string& from, const std::string& to) {
  if (key.size() <= from.size() || key.compare(key.size() - from.size(), from.size(), from) != 0) return "";
  return key.substr(0, key.size() - from.size()) + to;
}

std::string FormerName(const std::string& key) {
  for (const auto& [present, former] : kRenamed) {
    if (key == present) return former;
  }
  return WithEnding(key, "_lx", "_lux");
}

std::string PresentName(const std::string& key) { return WithEnding(key, "_lux", "_lx"); }

void AddAliases(json& values, std::string (*alias_of)(const std::string&)) {
  if (values.is_object()) {
    json aliases = json::object();
    for (const auto& [key, value] : values.items()) {
      const std::string alias = alias_of(key);
      if (!alias.empty() && !values.contains(alias)) aliases[alias] = value;
    }
    values.update(aliases);
  }
  for (json& value : values) {
    if (value.is_structured()) AddAliases(value, alias_of);
  }
}

}  // namespace

void AddFormerKeys(json& values) { AddAliases(values, FormerName); }

void AddPresentKeys(json& values) { AddAliases(values, PresentName); }

}  // namespace luxfit
