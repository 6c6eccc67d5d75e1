#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "apps/stages/fit_stop.h"
#include "apps/stages/parameter_json.h"
#include "apps/stages/session_light.h"
#include "apps/stages/stages.h"
#include "inverse/model/fit_uncertainty.h"
#include "inverse/observe/state_conflicts.h"

namespace luxfit {
namespace {

// Writes parameters as fitted (logarithms included) with their whole covariance, for further propagation.
void WriteArtifact(const RoomFit& room_fit, const RunContext& context) {
  const LuminaireFit& fit = room_fit.fit;
  nlohmann::json artifact = ProvenanceJson("luxfit-fit-1", context.provenance);
  artifact["message"] = fit.message;
  artifact["outer_iterations"] = fit.outer_iterations;
  artifact["rounds"] = room_fit.rounds;
  artifact["relative_model_error"] = fit.relative_sigma;
  artifact["undetermined"] = NamesOf(fit.undetermined);
  artifact["parameters"] = nlohmann::json::array();
  const FitUncertainty uncertainty = UncertaintyOf(fit);
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Parameter& p = fit.parameters[i];
    nlohmann::json entry = IdJson(p.id());
    entry["name"] = NameOf(p.id());
    entry["value"] = uncertainty.values[static_cast<Eigen::Index>(i)];
    entry["lower"] = p.lower;
    entry["upper"] = p.upper;
    entry["determined"] = static_cast<bool>(uncertainty.is_determined[i]);
    artifact["parameters"].push_back(std::move(entry));
  }
  artifact["covariance"] = nlohmann::json::array();
  for (const auto row : fit.covariance.rowwise())
    artifact["covariance"].push_back(std::vector<double>(row.begin(), row.end()));
  if (fit.patch_factor.size() > 0)
    artifact["patch_factor"] = std::vector<double>(fit.patch_factor.begin(), fit.patch_factor.end());
  WriteJson(context.out + "/stages/fit.json", artifact);
}

std::string TimeLeft(const RunContext& context) {
  return context.stop ? fmt::format(", at most {:.0f} s to go", context.stop->LeftS()) : "";
}

// Warns where photos show a luminaire otherwise than [states] says.
void WarnOfStates(const Session& session, const RoomFit& fit, const RoomObservations& given,
                  RunContext& context) {
  const std::vector<Luminaire>& luminaires = fit.fit.state.luminaires;
  for (const StateConflict& conflict : FindStateConflicts(given.seen, luminaires, given.dimming)) {
    const auto k = static_cast<size_t>(conflict.luminaire);
    if (!fit.luminaire_found[k]) continue;
    const std::string& id = luminaires[k].id;
    const std::string& state = session.states[static_cast<size_t>(conflict.state)].id;
    context.warnings.push_back(
        {"state_contradicted",
         conflict.is_bright
             ? fmt::format("photos show {} shining in state {}, in which [states] has it off", id, state)
             : fmt::format("most photos of state {} show {} dark, which [states] has on in it", state, id),
         fmt::format("correct {} of {} in [states], or see whether photos of {} are in another state", id,
                     state, state)});
  }
}

}  // namespace

RoomFit FitSession(const Session& session, const LinearizedSession& linearized, const Room& room,
                   const Evidence& observed, RunContext& context) {
  if (session.luminaires.empty()) {
    throw std::runtime_error(session.path +
                             ": states: expected the luminaires of at least one state, got none; add "
                             "[states] such as A = { A = 1.0 }");
  }
  const std::vector<LuminaireReading>& readings = linearized.readings;
  const bool fitted = std::any_of(readings.begin(), readings.end(), [](const LuminaireReading& r) {
    return r.given.role == ReadingRole::kFit;
  });
  if (observed.observations.empty() && !fitted && !session.photos.empty()) {
    throw std::runtime_error(
        session.path +
        ": photos: expected photos that show the front of the room's surfaces, got none; where "
        "facets face outwards, turn them round (`luxfit room` names them), else check that "
        "mesh and tags share one frame");
  }
  if (observed.observations.empty() && !fitted) {
    throw std::runtime_error(session.path +
                             ": expected something to fit to, got neither photos nor readings; add [photos], "
                             "or fit = [\"*\"] to [luxmeter]");
  }
  FitRoomOptions options;
  const std::string models =
      "choose";  // compares fits of single luminaires: its rounds have no residual of the whole
  std::atomic<bool> is_choosing = false;
  std::atomic<int> rounds = 0;
  options.on_step = [&](const std::string& step, const std::string& words) {
    is_choosing = step == models;
    return std::make_shared<StageTimer>(context, step, words);
  };
  options.on_round = [&](const FitRound& round) {
    Say(context, fmt::format("round {}, residual {:.2f} %{}", round.round, 100 * round.relative_sigma,
                             TimeLeft(context)));
  };
  options.stop_reason = [&] {
    if (is_choosing) Say(context, fmt::format("{} rounds of its fits{}", ++rounds, TimeLeft(context)));
    return context.stop ? context.stop->Reason() : "";
  };
  const RoomObservations given = RoomObservationsOf(session, linearized, room, observed);
  RoomFit fit = FitRoom(room, given, options);
  context.Add(fit.findings);
  WarnOfStates(session, fit, given, context);
  WriteArtifact(fit, context);
  return fit;
}

}  // namespace luxfit
