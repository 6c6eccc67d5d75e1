#include "inverse/fit/fit_room.h"
#include "inverse/fit/internal/judge/early_stop.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "inverse/choose/internal/choose_count.h"
#include "inverse/fit/internal/room_light.h"
#include "inverse/model/internal/measured_indirect.h"

namespace luxfit {
namespace {

LightState KnownReflectances(const Room& room, const RoomObservations& given) {
  LightState state;
  state.albedo = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(room.scene.materials.size()), 0.5);
  state.albedo_free.assign(room.scene.materials.size(), true);
  for (size_t m = 0; m < given.albedo.size(); ++m) {
    if (!given.albedo[m]) continue;
    state.albedo[static_cast<Eigen::Index>(m)] = *given.albedo[m];
    state.albedo_free[m] = false;
  }
  return state;
}

std::string ReasonOf(const CountChoice& choice, const std::string& scores) {
  if (choice.are_shown)
    return "photos show them, alike in height and area, and they explain the light to 5 %";
  const std::string of = " on patches left out (mean squared normalised error: " + scores + ")";
  if (choice.are_enough) return "photos show them beyond doubt, and no other number leaves a tenth less" + of;
  return "smallest within one standard error of the best, or within a quarter of it" + of;
}

void Record(const CountChoice& choice, const std::string& group, Findings& findings) {
  std::vector<std::string> among;
  std::string scores;
  for (size_t i = 0; i < choice.among.size(); ++i) {
    among.push_back(std::to_string(choice.among[i]));
    scores += fmt::format("{}{} {:.3f}", i == 0 ? "" : ", ", choice.among[i], choice.score[i]);
  }
  findings.choices.push_back({"number of luminaires" + (group.empty() ? "" : " of " + group),
                              std::to_string(choice.chosen), among, ReasonOf(choice, scores)});
  if (choice.chosen == 0) {
    findings.AddUndetermined(
        {"luminaires_not_counted",
         "the number of luminaires" + (group.empty() ? "" : " of " + group) +
             " is not determined: too little light was seen to place one and to test it on what was left out",
         "photograph more of the room, or name the luminaires in [states]"});
  } else if (choice.reached_max) {
    findings.warnings.push_back(
        {"luminaires_at_max",
         fmt::format("{} luminaires, the most that were tried, explain the light best: "
                     "there may be more",
                     choice.most),
         "raise luminaires.max, or switch luminaires in groups and name them in [states]"});
  }
}

}  // namespace

int CountLuminaires(const Room& room, const RoomObservations& given, const CountLuminairesOptions& options,
                    Findings& findings) {
  LightData data = LightOf(room, given).data;
  if (!data.observations.empty()) data = WithMeasuredIndirect(room, data);
  std::atomic<int> rounds = 0;
  data.checkpoint = CheckpointOf(options.stop_reason, rounds);
  std::vector<std::optional<Eigen::Vector3d>> known;
  for (const KnownLuminaire& luminaire : given.luminaires) known.push_back(luminaire.position_m);
  ChooseCountOptions choose;
  choose.max_count = options.max_count;
  const CountChoice choice = ChooseLuminaireCount(room, data, KnownReflectances(room, given), known,
                                                  given.seen, given.views, choose);
  Record(choice, options.group, findings);
  if (!choice.stopped.empty()) WarnOfStop({choice.stopped, "count"}, findings);
  return std::max(1, choice.chosen);
}

RoomObservations InOneState(RoomObservations given, int state) {
  const auto is_other = [state](const auto& row) { return row.state != state; };
  const auto keep = [&](auto& rows) {
    rows.erase(std::remove_if(rows.begin(), rows.end(), is_other), rows.end());
    for (auto& row : rows) row.state = 0;
  };
  keep(given.observations);
  keep(given.meter.readings);
  given.outlines.clear();
  std::vector<SeenPlace> seen;
  for (SeenPlace& place : given.seen) {
    if (std::find(place.states.begin(), place.states.end(), state) == place.states.end()) continue;
    place.states = {0};
    place.dark_states.clear();
    place.covered_states.clear();
    seen.push_back(std::move(place));
  }
  given.seen = std::move(seen);
  for (Watcher& view : given.views) {
    const bool has = std::find(view.states.begin(), view.states.end(), state) != view.states.end();
    view.states = has ? std::vector<int>{0} : std::vector<int>();
  }
  given.luminaires.clear();
  given.luminaires_are_named = false;
  given.dimming = {Eigen::VectorXd()};
  return given;
}

}  // namespace luxfit
