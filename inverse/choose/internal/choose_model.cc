#include "inverse/choose/internal/choose_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "inverse/choose/internal/left_out.h"
#include "inverse/choose/internal/luminaire_types.h"
#include "inverse/choose/internal/refine_luminaire.h"

namespace luxfit {
namespace {

// Holds the outcome for the luminaires of one type.
struct ChosenType {
  std::vector<int> luminaires;
  ChosenModel model = {};
  RefinedLuminaire refined = {};
  std::optional<PlacesChoice> places = {};

  void TakeOverInto(ModelChoice& result) const {
    const int first = luminaires.front();
    if (model.choice) result.choices.push_back(*model.choice);
    if (model.aim) result.aims.push_back(*model.aim);
    if (places) result.places.push_back(*places);
    for (Refinement step : refined.steps) {
      step.luminaire = first;
      result.refinements.push_back(std::move(step));
    }
    TakeOverInto(result.state, luminaires);
  }

  // Gives its model to luminaires of a state, in the order of its own.
  void TakeOverInto(LightState& state, const std::vector<int>& members) const {
    if (model.fitted) TakeOver(*model.fitted, state, members);
    for (size_t m = 0; m < members.size() && refined.changed; ++m) {
      state.luminaires[static_cast<size_t>(members[m])] = refined.members[m];
      state.free[static_cast<size_t>(members[m])] = refined.free;
    }
  }
};

// Chooses once more from the places that photos show, and keeps it unless the start predicts better by more than a
// standard error.
void TryPlaces(const Room& room, const TypePlaces& rival, const OpenChoice& open, const SubProblem& problem,
               ChosenType& chosen) {
  SubProblem moved = problem;
  double flux_lm = 0;
  for (const Luminaire& member : chosen.model.fitted->model.members) flux_lm += member.flux_lm;
  for (size_t m = 0; m < problem.members.size(); ++m) {
    Luminaire& luminaire = moved.state.luminaires[static_cast<size_t>(problem.members[m])];
    luminaire.position = rival.places[m];
    luminaire.flux_lm = flux_lm / static_cast<double>(problem.members.size());
  }
  ChosenModel model = ChooseLuminaire(room, moved, rival.first, open);
  if (!model.fitted) return;
  SelectionOptions photos_settle;
  photos_settle.keeps_first = true;
  const Selection selection =
      SelectAmong(problem, {&model.fitted->model, &chosen.model.fitted->model}, {0, 0}, photos_settle);
  const bool is_seen = selection.chosen == 0;
  chosen.places = PlacesChoice{chosen.luminaires, is_seen, selection.score[1], selection.score[0]};
  if (is_seen) chosen.model = std::move(model);
}

ChosenType ChooseType(const Room& room, const LightData& data, const LightState& start,
                      const std::vector<int>& luminaires, const OpenChoice& open,
                      const std::vector<ParameterPrior>& priors, const TypePlaces* rival) {
  const LightState typed = luminaires.size() > 1 ? WithTypes(start, start.first_of_type) : start;
  SubProblem problem = MakeSubProblem(room, data, typed, luminaires, priors);
  ChosenType chosen{luminaires};
  chosen.model = ChooseLuminaire(room, problem, luminaires.front(), open);
  if (rival != nullptr && chosen.model.fitted) TryPlaces(room, *rival, open, problem, chosen);
  if (chosen.model.fitted) TakeOver(*chosen.model.fitted, problem.state, problem.members);
  chosen.refined = RefineLuminaire(room, problem, open.refinements);
  return chosen;
}

// Lets a Lambertian lobe be narrower or wider: of luminaires of two kinds the mean may be Lambertian, and neither kind.
void FreeLobe(Luminaire& luminaire, FreeQuantities& free) {
  if (luminaire.distribution != Distribution::kLambertian) return;
  luminaire.distribution = Distribution::kCosinePower;
  luminaire.cosine_exponent = 1;
  free.exponent = true;
}

// Fits the luminaires of a type, as chosen, each with numbers of its own: from where the type ended, and from where it
// started, for luminaires of two kinds may have led it astray. Returns the better.
FittedModel Untied(const Room& room, const SubProblem& problem, const FittedCandidate& type) {
  LightState ended = problem.state;
  TakeOver(type, ended, problem.members);
  ended.first_of_type.clear();
  for (const int k : problem.members)
    FreeLobe(ended.luminaires[static_cast<size_t>(k)], ended.free[static_cast<size_t>(k)]);
  LightState started = ended;
  for (const int k : problem.members) {
    const auto member = static_cast<size_t>(k);
    started.luminaires[member] = OfTypeOf(ended.luminaires[member], problem.state.luminaires[member],
                                          ended.free[member].own_direction);
  }
  FittedModel from_end = FitState(room, problem, ended), from_start = FitState(room, problem, started);
  return SelectAmong(problem, {&from_end, &from_start}, {0, 0}).best == 0 ? from_end : from_start;
}

// Returns the luminaires of a type each with a model of its own where that predicts better by more than a
// standard error, else the type. The type is weighed as it was refined: luminaires that one table explains need no
// exponents of their own. Models of their own are looked for only where the type's numbers, untied, predict better:
// luminaires of one kind are spared the search, and others start from places that are right.
std::vector<ChosenType> OneOrSeveral(const Room& room, const LightData& data, const LightState& start,
                                     const std::vector<OpenChoice>& open,
                                     const std::vector<ParameterPrior>& priors, const ChosenType& type) {
  const SubProblem problem = MakeSubProblem(room, data, start, type.luminaires, priors);
  LightState as_type = problem.state;
  type.TakeOverInto(as_type, problem.members);
  const FittedModel tied = type.refined.changed ? FitState(room, problem, as_type) : type.model.fitted->model;
  const FittedModel untied = Untied(room, problem, *type.model.fitted);
  if (SelectAmong(problem, {&tied, &untied}, {0, 1}).chosen == 0) return {type};
  LightState near = start;
  for (size_t m = 0; m < type.luminaires.size(); ++m)
    near.luminaires[static_cast<size_t>(type.luminaires[m])] = untied.members[m];
  std::vector<ChosenType> single;
  LightState apart = problem.state;
  apart.first_of_type.clear();
  for (size_t m = 0; m < type.luminaires.size(); ++m) {
    const int k = type.luminaires[m];
    single.push_back(ChooseType(room, data, near, {k}, open[static_cast<size_t>(k)], priors, nullptr));
    if (!single.back().model.fitted) return {type};
    single.back().TakeOverInto(apart, {problem.members[m]});
  }
  const FittedModel several = FitState(room, problem, apart);
  const Selection selection = SelectAmong(problem, {&tied, &several}, {0, 1});
  return selection.chosen == 1 ? single : std::vector<ChosenType>{type};
}

}  // namespace

ModelChoice ChooseLuminaireModels(const Room& room, const LightData& data, const LightState& start,
                                  const std::vector<OpenChoice>& open,
                                  const std::vector<ParameterPrior>& priors,
                                  const std::vector<TypePlaces>& rivals) {
  if (open.size() != start.luminaires.size()) {
    throw std::invalid_argument("ChooseLuminaireModels: expected one OpenChoice a luminaire");
  }
  const std::vector<std::vector<int>> types = TypesOf(start);
  std::vector<std::vector<ChosenType>> chosen(types.size());
  std::vector<std::string> stop_reason(types.size());
  tbb::parallel_for(size_t{0}, types.size(), [&](size_t t) {
    const OpenChoice& of_first = open[static_cast<size_t>(types[t].front())];
    const auto rival = std::find_if(rivals.begin(), rivals.end(),
                                    [&](const TypePlaces& r) { return r.first == types[t].front(); });
    chosen[t] = {ChosenType{types[t]}};
    try {
      chosen[t] = {ChooseType(room, data, start, types[t], of_first, priors,
                              rival == rivals.end() ? nullptr : &*rival)};
      if (types[t].size() > 1 && chosen[t].front().model.fitted)
        chosen[t] = OneOrSeveral(room, data, start, open, priors, chosen[t].front());
    } catch (const FitStopped& stop) {
      stop_reason[t] = stop.what();
    }
  });
  ModelChoice result;
  result.state = start;
  for (const std::string& reason : stop_reason)
    if (!reason.empty()) result.stop_reason = reason;
  for (const std::vector<ChosenType>& of_type : chosen) {
    for (const ChosenType& type : of_type) {
      type.TakeOverInto(result);
      for (const int k : type.luminaires) {
        if (!result.state.first_of_type.empty())
          result.state.first_of_type[static_cast<size_t>(k)] = type.luminaires.front();
      }
    }
  }
  result.state = WithLikeTypes(std::move(result.state));
  return result;
}

}  // namespace luxfit
