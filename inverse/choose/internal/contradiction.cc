#include "inverse/choose/internal/contradiction.h"

#include "inverse/choose/internal/choose_model.h"
#include "inverse/choose/internal/left_out.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {
namespace {

constexpr double kStandardErrors = 2, kRatio = 2;

// Returns the luminaire without its given distribution and shape.
Luminaire Unsaid(Luminaire luminaire) {
  luminaire.distribution = Distribution::kCosinePower;
  luminaire.cosine_exponent = 1;
  luminaire.table = nullptr;
  luminaire.shape = LuminaireShape::kPoint;
  luminaire.size_m.setZero();
  return luminaire;
}

}  // namespace

std::vector<Contradiction> FindContradictions(const Room& room, const LightData& data,
                                              const LightState& start, const std::vector<OpenChoice>& open,
                                              const std::vector<ParameterPrior>& priors) {
  std::vector<Contradiction> contradictions;
  for (size_t k = 0; k < open.size(); ++k) {
    const FreeQuantities& free = start.free[k];
    if ((open[k].distribution && open[k].shape) || !free.flux) continue;
    std::vector<OpenChoice> others(open.size(), OpenChoice{false, false, false, false, {}});
    // Where every step solves the radiosity, only points are affordable.
    others[k] = {true, data.indirect_is_held, false, false, {}};
    LightState unsaid = start;
    unsaid.luminaires[k] = Unsaid(start.luminaires[k]);
    unsaid.free[k].exponent = true;
    const ModelChoice chosen = ChooseLuminaireModels(room, data, unsaid, others, priors);
    const auto luminaire = static_cast<int>(k);
    const SubProblem problem = MakeSubProblem(room, data, start, {luminaire}, priors);
    if (!problem.CanJudge()) continue;
    const FittedModel given = FitModel(room, problem, start.luminaires[k], free);
    const FittedModel better = FitModel(room, problem, chosen.state.luminaires[k], chosen.state.free[k]);
    const std::vector<GroupScores> scores = ScoreTogether(problem, {&given.left_out, &better.left_out});
    SelectionOptions selection_options;
    selection_options.standard_errors = kStandardErrors;
    selection_options.worth_having = kRatio - 1;
    const Selection selection =
        SimplestWithinOneStandardError({{scores[0], 0, true}, {scores[1], 1, true}}, selection_options);
    if (selection.chosen == 1)
      contradictions.push_back({luminaire, better.luminaire, selection.score[0], selection.score[1]});
  }
  return contradictions;
}

}  // namespace luxfit
