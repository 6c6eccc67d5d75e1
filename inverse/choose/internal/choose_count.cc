#include "inverse/choose/internal/choose_count.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "forward/luminaire/distribution_ops.h"
#include "inverse/choose/internal/left_out.h"
#include "inverse/model/fit_luminaires.h"
#include "inverse/model/internal/light_model.h"
#include "inverse/model/internal/search/first_guess.h"
#include "inverse/model/internal/search/sparse_luminaires.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {
namespace {

using KnownPositions = std::vector<std::optional<Eigen::Vector3d>>;

struct Trial {
  int count = 0;
  LeftOutPrediction left_out;
};

LightData WithCount(LightData data, int count) {
  for (Eigen::VectorXd& dimming : data.dimming) dimming = Eigen::VectorXd::Ones(count);
  return data;
}

// Returns a state with the luminaires as cosine-power discs about their places.
LightState StartOf(const SparseLuminaires& found, const LightState& given, double flux_per_strength,
                   double size_m) {
  LightState state = given;
  state.camera_scale = 1;
  state.camera_scale_free = state.meter_scale_free = false;
  for (const auto& [material, albedo] : found.albedo) {
    if (state.albedo_free[static_cast<size_t>(material)])
      state.albedo[material] = std::clamp(albedo, 0.05, 0.9);
  }
  state.luminaires.clear();
  state.free.clear();
  for (const SparseSource& source : found.sources) {
    Luminaire luminaire = source.luminaire;
    // A disc has an aim; it cannot be isotropic.
    const bool is_disc = OpsOf(luminaire.distribution).has_aim;
    if (is_disc) luminaire.shape = LuminaireShape::kDisc, luminaire.size_m.setConstant(size_m);
    luminaire.flux_lm = flux_per_strength * source.strength;
    state.luminaires.push_back(luminaire);
    FreeQuantities free;
    free.position = !source.is_held;
    free.exponent = free.size = is_disc;
    state.free.push_back(free);
  }
  return state;
}

bool AllGiveLight(const std::vector<SparseSource>& sources, double least_share) {
  double sum = 0;
  for (const SparseSource& source : sources) sum += source.strength;
  return std::all_of(sources.begin(), sources.end(),
                     [&](const SparseSource& source) { return source.strength > least_share * sum; });
}

// One fold judges all numbers, every fifth patch or reading. The search for places sees the others alone: a place
// that follows the errors of the rows that judge it would seem to be supported. Whole blocks in its place leave
// too few facets to judge by, and five folds in turn take five searches.
constexpr int kJudgingFold = 1;

void CutEveryFifth(const Room& room, SubProblem& problem) {
  const size_t observations = problem.data.observations.size();
  for (size_t i = 0; i < problem.fold_of_row.size(); ++i) {
    const int place =
        i < observations
            ? room.patches.elements[static_cast<size_t>(problem.data.observations[i].element)].patch
            : static_cast<int>(i - observations);
    problem.fold_of_row[i] = IsLeftOut(place) ? kJudgingFold : 0;
  }
}

LightData WithoutJudgingFold(const SubProblem& problem) {
  LightData data = problem.data;
  data.observations.clear();
  data.readings.clear();
  const size_t observations = problem.data.observations.size();
  for (size_t i = 0; i < problem.fold_of_row.size(); ++i) {
    if (problem.fold_of_row[i] == kJudgingFold) continue;
    if (i < observations) data.observations.push_back(problem.data.observations[i]);
    if (i >= observations) data.readings.push_back(problem.data.readings[i - observations]);
  }
  return data;
}

// Refines the luminaires of `found` together on `seen`, and predicts all rows of the problem.
std::optional<Trial> Try(const Room& room, const SubProblem& problem, const LightData& seen,
                         const LightState& given, const SparseLuminaires& found,
                         const ChooseCountOptions& options) {
  const auto count = static_cast<int>(found.sources.size());
  const LightData data = WithCount(seen, count), all = WithCount(problem.data, count);
  FitLuminairesOptions fit_options;
  fit_options.covariance = false;
  fit_options.max_outer_iterations = 4;
  fit_options.visibility_order = 2;
  const double flux_per_strength = data.observations.empty() ? 1 : M_PI;  // readings: 1, photos: pi
  const LuminaireFit fit = FitLuminaires(
      room, data, StartOf(found, given, flux_per_strength, options.start_size_m), {}, fit_options);
  if (fit.status == FitStatus::kNoData) return {};
  LightModel model(room, all);
  model.FreezeVisibility(fit.state, fit_options.visibility_order);
  LeftOutPrediction left_out{model.Predict(fit.state, {}, false).value, model.InPenumbra(),
                             fit.relative_sigma, fit.material_texture_sigma};
  left_out.is_smooth.flip();
  for (size_t i = 0; i < left_out.is_smooth.size(); ++i)
    left_out.is_smooth[i] = left_out.is_smooth[i] && problem.fold_of_row[i] == kJudgingFold;
  return Trial{count, std::move(left_out)};
}

Selection Select(const SubProblem& problem, const std::vector<Trial>& trials) {
  std::vector<const LeftOutPrediction*> left_out;
  left_out.reserve(trials.size());
  for (const Trial& trial : trials) left_out.push_back(&trial.left_out);
  const std::vector<GroupScores> scores = ScoreTogether(problem, left_out);
  std::vector<SelectionCandidate> candidates;
  candidates.reserve(trials.size());
  for (size_t t = 0; t < trials.size(); ++t)
    candidates.push_back({scores[t], static_cast<double>(trials[t].count), true});
  return SimplestWithinOneStandardError(candidates);
}

}  // namespace

CountChoice ChooseLuminaireCount(const Room& room, const LightData& data, const LightState& state,
                                 const KnownPositions& known_positions, const ChooseCountOptions& options) {
  const int least = std::max(1, static_cast<int>(known_positions.size()));
  if (options.max_count < least)
    throw std::invalid_argument(
        "ChooseLuminaireCount: expected max_count of at least 1 and of the known places");
  SubProblem problem = CutAll(room, data, options.max_elements);
  CutEveryFifth(room, problem);
  CountChoice choice;
  if (!problem.CanJudge()) return choice;
  std::vector<Trial> trials;
  constexpr int kPatience = 2;  // numbers in a row without gain that end the search
  const FirstGuessOptions guess_options;
  const LightData seen = WithoutJudgingFold(problem);
  const GroupedLight light = GroupLight(room, WithCount(seen, 1), guess_options.max_elements);
  const SparseSearch search(room, light, guess_options.grid_m, guess_options.refinements);
  SparseLuminaires found;
  for (const std::optional<Eigen::Vector3d>& place : known_positions) {
    if (!place) continue;
    found.sources.emplace_back();
    found.sources.back().luminaire.position = *place;
    found.sources.back().is_held = true;
  }
  try {
    for (int count = least; count <= options.max_count; ++count) {
      if (data.checkpoint) data.checkpoint(data.is_part);
      found = search.Find(0, count, found.sources);
      if (static_cast<int>(found.sources.size()) < count || !AllGiveLight(found.sources, options.least_share))
        break;
      const std::optional<Trial> trial = Try(room, problem, seen, state, found, options);
      if (!trial) break;
      trials.push_back(*trial);
      if (trials.size() - 1 - Select(problem, trials).best >= kPatience) break;
    }
  } catch (const FitStopped& stop) {
    choice.stopped = stop.what();
  }
  if (trials.empty()) return choice;
  Selection selection = Select(problem, trials);
  for (const Trial& trial : trials) choice.among.push_back(trial.count);
  choice.chosen = trials[selection.chosen].count;
  choice.score = std::move(selection.score);
  choice.standard_error = std::move(selection.standard_error);
  choice.reached_max = trials[selection.best].count == options.max_count;
  return choice;
}

}  // namespace luxfit
