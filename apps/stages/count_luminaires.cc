#include "apps/stages/count_luminaires.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "apps/stages/internal/light_data.h"
#include "inverse/choose/choose_count.h"
#include "inverse/model/measured_indirect.h"

namespace luxfit {
namespace {

LightState KnownReflectances(const Session& session, const Room& room) {
  const auto materials = static_cast<Eigen::Index>(room.scene.materials.size());
  LightState state;
  state.albedo = Eigen::VectorXd::Constant(materials, 0.5);
  state.albedo_free.assign(room.scene.materials.size(), true);
  const std::vector<std::optional<double>> known = KnownAlbedo(session, room);
  for (size_t m = 0; m < known.size(); ++m) {
    if (!known[m]) continue;
    state.albedo[static_cast<Eigen::Index>(m)] = *known[m];
    state.albedo_free[m] = false;
  }
  return state;
}

void Record(const CountChoice& choice, int most, RunContext& context) {
  std::vector<std::string> among;
  std::string scores;
  for (size_t i = 0; i < choice.among.size(); ++i) {
    among.push_back(std::to_string(choice.among[i]));
    scores += fmt::format("{}{} {:.3f}", i == 0 ? "" : ", ", choice.among[i], choice.score[i]);
  }
  context.choices.push_back(
      {"number of luminaires", std::to_string(choice.chosen), among,
       "smallest within one standard error of the best on patches left out (mean squared "
       "normalised error: " +
           scores + ")"});
  if (choice.chosen == 0) {
    context.undetermined = true;
    context.warnings.push_back(
        {"luminaires_not_counted",
         "the number of luminaires is not determined: too little light was seen to place "
         "one and to test it on what was left out",
         "photograph more of the room, or name the luminaires in [states]"});
  } else if (choice.reached_max) {
    context.warnings.push_back(
        {"luminaires_at_max",
         fmt::format("{} luminaires, the most that were tried, explain the light best: "
                     "there may be more",
                     most),
         "raise luminaires.max, or switch luminaires in groups and name them in [states]"});
  }
}

}  // namespace

Session WithCountedLuminaires(Session session, const Room& room, const std::vector<Observation>& observations,
                              RunContext& context) {
  if (!session.count_is_estimated) return session;
  const StageTimer timer(context, "count", "how many luminaires there are");
  LightData data = LightOf(session, observations).data;
  if (!data.observations.empty()) data = WithMeasuredIndirect(room, data);
  std::vector<std::optional<Eigen::Vector3d>> known;
  for (const SessionLuminaire& luminaire : session.luminaires) known.push_back(luminaire.position_m);
  ChooseCountOptions options;
  options.max_count = session.max_luminaires;
  const CountChoice choice =
      ChooseLuminaireCount(room, data, KnownReflectances(session, room), known, options);
  Record(choice, options.max_count, context);
  return WithMoreLuminaires(std::move(session), std::max(1, choice.chosen));
}

}  // namespace luxfit
