#include "inverse/choose/internal/several_starts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

#include "forward/luminaire/distribution_ops.h"
#include "inverse/choose/internal/left_out.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {
namespace {

// Returns the luminaire's model at the rival's place.
Luminaire At(const Luminaire& luminaire, const Luminaire& rival) {
  Luminaire start = luminaire;
  start.position = rival.position;
  if (OpsOf(luminaire.distribution).has_exponent) {
    start.aim = rival.aim;
    start.cosine_exponent = std::max(1.0, rival.cosine_exponent);
  }
  return start;
}

// Bounds by how much of the best score what the mesh lacks may favour a place in mid-air.
constexpr double kWorthLeavingSeen = 0.5;

StartComparison Compared(const SubProblem& problem, const std::vector<Luminaire>& starts,
                         const std::vector<FittedModel>& fitted, bool is_first_seen,
                         const SeveralStartsOptions& options) {
  StartComparison comparison;
  std::vector<const LeftOutPrediction*> left_out;
  for (size_t i = 0; i < fitted.size(); ++i) {
    comparison.start.push_back(starts[i].position);
    comparison.end.push_back(fitted[i].luminaire);
    left_out.push_back(&fitted[i].left_out);
  }
  std::vector<SelectionCandidate> candidates;
  for (GroupScores& scores : ScoreTogether(problem, left_out))
    candidates.push_back({std::move(scores), 0, true});
  SelectionOptions selection_options;
  selection_options.keeps_first = true;
  if (is_first_seen) selection_options.worth_having = kWorthLeavingSeen;
  const Selection selection = SimplestWithinOneStandardError(candidates, selection_options);
  comparison.score = selection.score;
  const size_t chosen = selection.chosen;
  comparison.chosen = static_cast<int>(chosen);
  for (size_t i = 0; i < fitted.size(); ++i) {
    const PairedDifference worse = Difference(candidates[i].scores, candidates[chosen].scores);
    comparison.standard_error.push_back(i == chosen ? 0 : worse.standard_error);
    const double apart_m = (comparison.end[i].position - comparison.end[chosen].position).norm();
    if (apart_m <= options.same_place_m) ++comparison.agreeing;
    if (apart_m > options.other_place_m && worse.mean <= worse.standard_error)
      comparison.rivals.push_back(static_cast<int>(i));
  }
  return comparison;
}

}  // namespace

SeveralStarts FitFromSeveralStarts(const Room& room, const LightData& data, const LightState& state,
                                   const std::vector<std::vector<Luminaire>>& rivals,
                                   const std::vector<ParameterPrior>& priors,
                                   const std::vector<ParameterPrior>& own_priors,
                                   const SeveralStartsOptions& options) {
  if (rivals.size() != state.luminaires.size())
    throw std::invalid_argument("FitFromSeveralStarts: rivals: expected one list a luminaire");
  SeveralStarts result{state, {}};
  for (size_t k = 0; k < rivals.size(); ++k) {
    if (rivals[k].empty() || !state.free[k].position) continue;
    const SubProblem problem =
        MakeSubProblem(room, data, result.state, {static_cast<int>(k)}, priors, options.max_elements);
    if (!problem.CanJudge()) continue;
    std::vector<ParameterPrior> with_own = priors;
    with_own.insert(with_own.end(), own_priors.begin(), own_priors.end());
    SubProblem own = problem;
    own.priors = PriorsOfProblem(problem, {static_cast<int>(k)}, with_own);
    std::vector<Luminaire> starts = {state.luminaires[k]};
    for (const Luminaire& rival : rivals[k]) {
      if (static_cast<int>(starts.size()) < options.max_starts)
        starts.push_back(At(state.luminaires[k], rival));
    }
    std::vector<FittedModel> fitted(starts.size());
    tbb::parallel_for(size_t{0}, starts.size(), [&](size_t i) {
      fitted[i] = FitModel(room, i == 0 ? own : problem, starts[i], state.free[k],
                           {options.max_outer_iterations, options.max_inner_iterations});
    });
    const bool is_first_seen = own.priors.size() > problem.priors.size();
    StartComparison comparison = Compared(problem, starts, fitted, is_first_seen, options);
    comparison.luminaire = static_cast<int>(k);
    result.state.luminaires[k] = fitted[static_cast<size_t>(comparison.chosen)].luminaire;
    result.comparisons.push_back(std::move(comparison));
  }
  return result;
}

}  // namespace luxfit
