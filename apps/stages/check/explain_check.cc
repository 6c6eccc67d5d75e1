#include "apps/stages/check/explain_check.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/text/formats/json_vectors.h"
#include "inverse/fit/explaining_light.h"

namespace luxfit {
namespace {

std::string RemedyOf(const std::vector<ReadingExplanation>& explanations) {
  std::string remedy;
  for (const ReadingExplanation& e : explanations) {
    if (remedy.find(e.remedy) == std::string::npos) remedy += (remedy.empty() ? "" : "; or ") + e.remedy;
  }
  return remedy;
}

}  // namespace

std::vector<ReadingExplanation> ExplainCheck(const Session& session,
                                             const std::vector<LuminaireReading>& readings, const Room& room,
                                             const RoomFit& fit) {
  std::vector<std::string> states;
  for (const SessionState& state : session.states) states.push_back(state.id);
  const std::optional<ExplainingLight> light = ExplainingLightOf(room, fit, states);
  if (!light) return {};
  std::vector<ReadingAsGiven> given;
  for (size_t i = 0; i < readings.size(); ++i) {
    const Reading& reading = fit.data.readings[i];
    const SessionReading& row = readings[i].given;
    if (!row.is_measured || !IsLit(fit, reading.state)) continue;
    given.push_back({row.id, reading.sensor, reading.state, readings[i].illuminance_lx, reading.sigma_lx,
                     row.role != ReadingRole::kCheck});
  }
  // Where none checks, the fit was asked to follow them all: there is no check to explain.
  const bool has_check =
      std::any_of(given.begin(), given.end(), [](const ReadingAsGiven& r) { return !r.sets_scale; });
  if (!has_check) return {};
  return ExplainReadings(*light, given);
}

void WarnOfExplanations(const std::vector<ReadingExplanation>& explanations, Findings& findings) {
  if (explanations.empty()) return;
  constexpr double kLargePercent = 5;
  const bool is_small = explanations.front().rms_percent_as_given <= kLargePercent;
  findings.warnings.push_back({"readings_as_if", InWords(explanations), RemedyOf(explanations), !is_small});
}

nlohmann::json ExplainedJson(const std::vector<ReadingExplanation>& explanations) {
  nlohmann::json by = nlohmann::json::array();
  for (const ReadingExplanation& e : explanations)
    by.push_back({{"as_if", e.as_if}, {"remedy", e.remedy}, {"rms_percent", NumberOrNull(e.rms_percent)}});
  return {{"message", InWords(explanations)},
          {"remedy", RemedyOf(explanations)},
          {"rms_percent_as_given", NumberOrNull(explanations.front().rms_percent_as_given)},
          {"by", by}};
}

}  // namespace luxfit
