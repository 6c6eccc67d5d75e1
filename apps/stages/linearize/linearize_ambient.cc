#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "apps/stages/linearize/linearize.h"
#include "apps/text/suggest.h"

namespace luxfit {

bool IsAmbient(const Session& session, const SessionState& state) {
  // Without [states] all luminaires are on.
  return !session.count_is_estimated && std::all_of(state.dimming.begin(), state.dimming.end(),
                                                    [](const auto& one) { return one.second == 0; });
}

std::vector<LuminaireReading> ReadingsWithoutAmbient(const Session& session, RunContext& context) {
  std::set<std::string> ambient_states;
  for (const SessionState& state : session.states) {
    if (IsAmbient(session, state)) ambient_states.insert(state.id);
  }
  std::map<std::string, double> ambient_lx;
  for (const SessionReading& reading : session.luxmeter.readings) {
    if (reading.is_measured && ambient_states.count(reading.state) > 0)
      ambient_lx.emplace(reading.id, reading.illuminance_lx);
  }
  std::vector<LuminaireReading> readings;
  readings.reserve(session.luxmeter.readings.size());
  std::vector<std::string> unmeasured;
  for (const SessionReading& reading : session.luxmeter.readings) {
    if (ambient_states.count(reading.state) > 0) continue;
    const auto ambient = ambient_lx.find(reading.id);
    const bool is_known = ambient != ambient_lx.end();
    const double off_lx = is_known ? ambient->second : 0;
    readings.push_back({reading, reading.illuminance_lx - off_lx, off_lx});
    if (!is_known && reading.is_measured && std::count(unmeasured.begin(), unmeasured.end(), reading.id) == 0)
      unmeasured.push_back(reading.id);
  }
  if (ambient_states.empty() || session.luxmeter.readings.empty()) return readings;
  context.choices.push_back({"ambient light in readings",
                             "subtracted",
                             {},
                             fmt::format("the all-off state was measured at {} places", ambient_lx.size())});
  if (!unmeasured.empty()) {
    context.warnings.push_back(
        {"ambient_in_readings",
         "readings of " + ListNames(unmeasured) + " include the ambient light, which was not measured there",
         "measure these places with all luminaires off too, or give role check to them only"});
  }
  return readings;
}

}  // namespace luxfit
