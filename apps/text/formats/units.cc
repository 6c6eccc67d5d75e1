#include "apps/text/formats/units.h"

#include <map>
#include <utility>

namespace luxfit {
namespace {

struct Unit {
  std::string base;
  double factor;
};

std::optional<Unit> FindUnit(const std::string& name) {
  static const std::map<std::string, Unit> units = {{"m", {"m", 1}},       {"cm", {"m", 0.01}},
                                                    {"mm", {"m", 0.001}},  {"km", {"m", 1000}},
                                                    {"in", {"m", 0.0254}}, {"ft", {"m", 0.3048}},
                                                    {"lx", {"lx", 1}},     {"klx", {"lx", kLuxPerKilolux}},
                                                    {"s", {"s", 1}},       {"fc", {"lx", kLuxPerFootcandle}},
                                                    {"ms", {"s", 0.001}},  {"us", {"s", 1e-6}}};
  const auto at = units.find(name);
  if (at == units.end()) return std::nullopt;
  return at->second;
}

// Returns what stands before the last underscore, and after it.
std::pair<std::string, std::string> StemAndUnit(const std::string& name) {
  const size_t at = name.rfind('_');
  if (at == std::string::npos) return {name, ""};
  return {name.substr(0, at), name.substr(at + 1)};
}

}  // namespace

std::optional<double> UnitFactor(const std::string& name, const std::string& wanted) {
  const auto [stem, unit] = StemAndUnit(name);
  const auto [wanted_stem, wanted_unit] = StemAndUnit(wanted);
  const std::optional<Unit> from = FindUnit(unit), to = FindUnit(wanted_unit);
  if (stem != wanted_stem || !from || !to || from->base != to->base) return std::nullopt;
  return from->factor / to->factor;
}

}  // namespace luxfit
