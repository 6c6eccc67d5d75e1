#include "inverse/choose/internal/two_sides.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "forward/luminaire/luminaire_parts.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {
namespace {

constexpr double kExplained = 0.01;  // model error that a luxmeter, read to 3 %, would not show
constexpr int kMaxElements = 1000;

// Returns the fit of a point that lights both sides where left-out data prefer one.
std::optional<FittedModel> FitTwoSides(const Room& room, const SubProblem& problem) {
  const auto k = static_cast<size_t>(problem.luminaire);
  const Luminaire& start = problem.state.luminaires[k];
  FreeQuantities free = problem.state.free[k];
  const FittedModel one = FitModel(room, problem, start, free);
  if (one.left_out.relative_sigma <= kExplained) return {};
  free.exponent = free.tilt = false;
  Luminaire globe = start;
  globe.distribution = Distribution::kIsotropic;
  FittedModel even = FitModel(room, problem, globe, free);
  free.sides = true;
  FittedModel two = FitModel(room, problem, LitOnBothSides(start), free);
  std::vector<GroupScores> scores = ScoreTogether(problem, {&one.left_out, &even.left_out, &two.left_out});
  SelectionOptions options;
  options.keeps_first = true;
  const Selection selection = SimplestWithinOneStandardError(
      {{std::move(scores[0]), 1, true}, {std::move(scores[1]), 0, true}, {std::move(scores[2]), 1, true}},
      options);
  if (selection.chosen == 0) return {};
  return selection.chosen == 1 ? even : two;
}

}  // namespace

bool SeesBothSides(const Room& room, const SubProblem& problem, const Luminaire& luminaire) {
  constexpr double kBarely = 0.1;  // cosine
  constexpr double kBehindM = 0.1;
  if (room.rays.Occluded(luminaire.position, luminaire.position - kBehindM * luminaire.aim)) return false;
  double lowest = 0, highest = 0;
  const auto see = [&](const Eigen::Vector3d& p) {
    const double cosine = luminaire.aim.dot((p - luminaire.position).normalized());
    lowest = std::min(lowest, cosine);
    highest = std::max(highest, cosine);
  };
  for (const Observation& o : problem.data.observations)
    see(room.patches.elements[static_cast<size_t>(o.element)].center);
  for (const Reading& reading : problem.data.readings) see(reading.sensor.position);
  return lowest < -kBarely && highest > kBarely;
}

Luminaire LitOnBothSides(Luminaire luminaire, double share_up) {
  if (luminaire.aim.z() > 0) luminaire.aim = -luminaire.aim;
  luminaire.distribution = Distribution::kMeasured;
  luminaire.table = std::make_shared<IntensityTable>(TwoSidedTable(share_up));
  return luminaire;
}

std::optional<LightState> WithTwoSides(const Room& room, const LightData& data, const LightState& state,
                                       const std::vector<bool>& is_open,
                                       const std::vector<ParameterPrior>& priors) {
  std::optional<LightState> result;
  for (size_t k = 0; k < is_open.size(); ++k) {
    if (!is_open[k] || state.luminaires[k].shape != LuminaireShape::kPoint) continue;
    const SubProblem problem = MakeSubProblem(room, data, state, {static_cast<int>(k)}, priors, kMaxElements);
    if (!problem.CanJudge() || !SeesBothSides(room, problem, state.luminaires[k])) continue;
    const std::optional<FittedModel> two = FitTwoSides(room, problem);
    if (!two || !SeesBothSides(room, problem, two->luminaire)) continue;
    if (!result) result = state;
    result->luminaires[k] = two->luminaire;
    result->free[k] = two->free;
  }
  return result;
}

}  // namespace luxfit
