#include "inverse/choose/internal/left_out.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "inverse/choose/internal/held_luminaires.h"
#include "inverse/model/internal/blocks/outline_block.h"
#include "inverse/model/internal/weights/row_whitening.h"
#include "inverse/select/internal/spatial_blocks.h"

namespace luxfit {
namespace {

constexpr int kFolds = 5;
constexpr int kBlocksPerFold = 8;

double SumOf(const Eigen::VectorXd& dimming, const std::vector<int>& luminaires) {
  double sum = 0;
  for (const int k : luminaires) sum += dimming[k];
  return sum;
}

bool OnAlone(const Eigen::VectorXd& dimming, const std::vector<int>& luminaires) {
  constexpr double kRounding = 1e-9;
  const double sum = SumOf(dimming, luminaires);
  return sum > 0 && dimming.sum() - sum < kRounding;
}

std::vector<Observation> ObservationsOf(const LightData& data, const std::vector<bool>& state_used,
                                        int max_elements) {
  std::vector<Observation> own;
  for (const Observation& o : data.observations) {
    if (state_used[static_cast<size_t>(o.state)]) own.push_back(o);
  }
  return ThinElements(own, max_elements);
}

// `only_members`: the others are left out, not held.
LightState StateOfProblem(const LightState& start, const std::vector<int>& members, bool only_members,
                          bool with_albedo) {
  LightState state = start;
  if (!with_albedo) state.albedo_free.assign(state.albedo_free.size(), false);
  state.camera_scale_free = false;
  state.meter_scale_free = false;
  state.ambient_shares_free = false;
  state.first_of_type.clear();
  if (only_members) {
    state.luminaires.clear(), state.free.clear();
    for (const int k : members) {
      state.luminaires.push_back(start.luminaires[static_cast<size_t>(k)]);
      state.free.push_back(start.free[static_cast<size_t>(k)]);
    }
    state.first_of_type.assign(members.size(), 0);
    return state;
  }
  for (int j = 0; j < static_cast<int>(state.free.size()); ++j) {
    const bool is_member = std::find(members.begin(), members.end(), j) != members.end();
    if (!is_member) state.free[static_cast<size_t>(j)] = {false, false, false, false, false};
    state.first_of_type.push_back(is_member ? members.front() : j);
  }
  return state;
}

void CutIntoBlocks(const std::vector<Eigen::Vector3d>& place_of_row, SubProblem& problem) {
  problem.group_of_row = SpatialBlocks(place_of_row, kFolds * kBlocksPerFold);
  problem.fold_of_row = problem.group_of_row;
  for (int& fold : problem.fold_of_row) fold %= kFolds;
}

void AddObservations(const Room& room, std::vector<Observation> observations, SubProblem& problem) {
  problem.data.observations = std::move(observations);
  std::vector<Eigen::Vector3d> places;
  for (const Observation& o : problem.data.observations) {
    const int patch = room.patches.elements[static_cast<size_t>(o.element)].patch;
    places.push_back(room.patches.patches[static_cast<size_t>(patch)].center);
    problem.element_of_row.push_back(o.element);
    problem.material_of_row.push_back(room.patches.patches[static_cast<size_t>(patch)].material);
    problem.value.push_back(o.relative_luminance);
    problem.variance.push_back(o.variance);
  }
  CutIntoBlocks(places, problem);
}

void AddReadings(const LightData& data, const std::vector<bool>& state_used, SubProblem& problem) {
  std::vector<Eigen::Vector3d> places;
  for (const Reading& reading : data.readings) {
    if (!state_used[static_cast<size_t>(reading.state)] || !reading.used) continue;
    problem.data.readings.push_back(reading);
    places.push_back(reading.sensor.position);
    problem.value.push_back(reading.illuminance_lx);
    problem.variance.push_back(reading.sigma_lx * reading.sigma_lx);
  }
  CutIntoBlocks(places, problem);
}

// Adds an outline. A fold leaves whole views out.
void AddOutline(const SeenOutline& outline, int luminaire, SubProblem& problem) {
  constexpr int kFirstGroup = 1 << 28;  // apart from blocks
  problem.data.outlines.push_back({luminaire, outline});
  for (size_t i = 0; i < outline.rays.size(); ++i) {
    problem.group_of_row.push_back(kFirstGroup + outline.view);
    problem.fold_of_row.push_back(outline.view % kFolds);
    problem.value.push_back(0);
    problem.variance.push_back(kOutlineSigmaPx * kOutlineSigmaPx);
  }
}

// Returns the whitening of what the rows of an element share by its texture.
RowWhitening TextureOf(const SubProblem& problem, const LeftOutPrediction& model,
                       const Eigen::VectorXd& root_weight) {
  std::map<int, std::vector<Eigen::Index>> rows;
  for (size_t i = 0; i < problem.element_of_row.size(); ++i)
    rows[problem.element_of_row[i]].push_back(static_cast<Eigen::Index>(i));
  RowWhitening whitening;
  std::vector<double> effect;
  for (const auto& [element, own] : rows) {
    const double sigma = model.texture_sigma[problem.material_of_row[static_cast<size_t>(own.front())]];
    effect.clear();
    for (const Eigen::Index i : own)
      effect.push_back(sigma * problem.value[static_cast<size_t>(i)] * root_weight[i]);
    whitening.Add(own, effect);
  }
  return whitening;
}

}  // namespace

bool SubProblem::CanJudge() const {
  return std::any_of(fold_of_row.begin(), fold_of_row.end(), [](int fold) { return fold > 0; });
}

SubProblem MakeSubProblem(const Room& room, const LightData& data, const LightState& start,
                          const std::vector<int>& luminaires, const std::vector<ParameterPrior>& priors,
                          int max_elements) {
  SubProblem problem;
  const auto is_alone = [&](int state) {
    return OnAlone(data.dimming[static_cast<size_t>(state)], luminaires);
  };
  const bool photos = !data.observations.empty();
  const bool alone = photos ? std::any_of(data.observations.begin(), data.observations.end(),
                                          [&](const Observation& o) { return is_alone(o.state); })
                            : std::any_of(data.readings.begin(), data.readings.end(),
                                          [&](const Reading& r) { return r.used && is_alone(r.state); });
  // The others are off, or their light is known.
  const bool only_members = alone || (photos && data.indirect_is_held);
  problem.state = StateOfProblem(start, luminaires, only_members, photos && data.indirect_is_held);
  problem.members = luminaires;
  if (only_members) std::iota(problem.members.begin(), problem.members.end(), 0);
  problem.luminaire = problem.members.front();
  std::vector<bool> state_used;
  for (const Eigen::VectorXd& dimming : data.dimming) {
    state_used.push_back(alone ? OnAlone(dimming, luminaires) : SumOf(dimming, luminaires) > 0);
    problem.data.dimming.push_back(only_members ? Eigen::VectorXd(dimming(luminaires)) : dimming);
  }
  problem.data.indirect_is_held = data.indirect_is_held;
  problem.data.pose_root = data.pose_root;
  problem.data.checkpoint = data.checkpoint;
  problem.data.is_part = true;
  const auto member_of = [&](int luminaire) {
    const auto at = std::find(luminaires.begin(), luminaires.end(), luminaire);
    return at == luminaires.end() ? -1 : problem.members[static_cast<size_t>(at - luminaires.begin())];
  };
  if (photos) {
    std::vector<Observation> own = ObservationsOf(data, state_used, max_elements);
    if (only_members && !alone) own = WithHeldLight(room, data.dimming, start, luminaires, std::move(own));
    AddObservations(room, std::move(own), problem);
    for (const LuminaireOutline& outline : data.outlines) {
      if (member_of(outline.luminaire) >= 0 && state_used[static_cast<size_t>(outline.seen.state)])
        AddOutline(outline.seen, member_of(outline.luminaire), problem);
    }
  } else {
    AddReadings(data, state_used, problem);
  }
  problem.priors = PriorsOfProblem(problem, luminaires, priors);
  return problem;
}

std::vector<ParameterPrior> PriorsOfProblem(const SubProblem& problem, const std::vector<int>& luminaires,
                                            const std::vector<ParameterPrior>& priors) {
  std::vector<ParameterPrior> own;
  for (ParameterPrior prior : priors) {
    if (prior.kind == ParameterKind::kLogSensorGain) own.push_back(prior);
    if (prior.kind != ParameterKind::kLuminaire && prior.kind != ParameterKind::kLogFlux) continue;
    const auto at = std::find(luminaires.begin(), luminaires.end(), prior.index);
    if (at == luminaires.end()) continue;
    prior.index = problem.members[static_cast<size_t>(at - luminaires.begin())];
    own.push_back(prior);
  }
  return own;
}

SubProblem CutAll(const Room& room, const LightData& data, int max_elements) {
  SubProblem problem;
  const std::vector<bool> every_state(data.dimming.size(), true);
  problem.data.dimming = data.dimming;
  problem.data.indirect_is_held = data.indirect_is_held;
  problem.data.pose_root = data.pose_root;
  problem.data.checkpoint = data.checkpoint;
  problem.data.is_part = true;
  if (data.observations.empty()) {
    AddReadings(data, every_state, problem);
  } else {
    AddObservations(room, ObservationsOf(data, every_state, max_elements), problem);
    for (const LuminaireOutline& outline : data.outlines)
      AddOutline(outline.seen, outline.luminaire, problem);
  }
  return problem;
}

FittedModel FitModel(const Room& room, const SubProblem& problem, const Luminaire& start,
                     const FreeQuantities& free, const FitEffort& effort) {
  LightState state = problem.state;
  for (const int k : problem.members) {
    const auto member = static_cast<size_t>(k);
    state.luminaires[member] =
        k == problem.luminaire ? start : OfTypeOf(start, state.luminaires[member], free.own_direction);
    state.free[member] = free;
  }
  return FitState(room, problem, state, effort);
}

FittedModel FitState(const Room& room, const SubProblem& problem, const LightState& start,
                     const FitEffort& effort) {
  const FreeQuantities& free = start.free[static_cast<size_t>(problem.luminaire)];
  FitLuminairesOptions options;
  options.covariance = free.table_sigma > 0 || free.emission_sigma > 0;  // gives the effective parameters
  options.max_outer_iterations = effort.max_outer_iterations;
  options.max_inner_iterations = effort.max_inner_iterations;
  options.has_texture = false;  // the data are without it (inverse/fit/internal/surface_texture.h)
  const LuminaireFit fit = FitLuminaires(room, problem.data, start, problem.priors, options);
  std::vector<Luminaire> members;
  members.reserve(problem.members.size());
  for (const int k : problem.members) members.push_back(fit.state.luminaires[static_cast<size_t>(k)]);
  return {members.front(), members, free,
          PredictLeftOut(room, problem.data, fit, problem.priors, problem.fold_of_row), fit.effective_parts};
}

std::vector<bool> LeaveMostRowsSmooth(const SubProblem& problem,
                                      const std::vector<const LeftOutPrediction*>& models) {
  const auto photos = static_cast<std::ptrdiff_t>(problem.element_of_row.size());
  std::vector<std::ptrdiff_t> smooth;
  smooth.reserve(models.size());
  for (const LeftOutPrediction* model : models)
    smooth.push_back(std::count(model->is_smooth.begin(), model->is_smooth.begin() + photos, true));
  const std::ptrdiff_t most = *std::max_element(smooth.begin(), smooth.end());
  std::vector<bool> leave(models.size());
  for (size_t m = 0; m < models.size(); ++m) leave[m] = 2 * smooth[m] >= most;
  return leave;
}

std::vector<GroupScores> ScoreTogether(const SubProblem& problem,
                                       const std::vector<const LeftOutPrediction*>& models) {
  const std::vector<bool> counted = LeaveMostRowsSmooth(problem, models);
  std::vector<const LeftOutPrediction*> judges;
  for (size_t m = 0; m < models.size(); ++m)
    if (counted[m]) judges.push_back(models[m]);
  const LeftOutPrediction& best = **std::min_element(
      judges.begin(), judges.end(), [](const LeftOutPrediction* a, const LeftOutPrediction* b) {
        return a->relative_sigma < b->relative_sigma;
      });
  const auto rows = static_cast<Eigen::Index>(problem.value.size());
  Eigen::VectorXd root_weight(rows);  // 0: does not count
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto row = static_cast<size_t>(i);
    const bool counts = std::all_of(judges.begin(), judges.end(),
                                    [&](const LeftOutPrediction* model) { return model->is_smooth[row]; });
    const double variance = std::pow(best.relative_sigma * problem.value[row], 2) + problem.variance[row];
    root_weight[i] = counts ? 1 / std::sqrt(variance) : 0;
  }
  const RowWhitening whitening = TextureOf(problem, best, root_weight);
  std::vector<GroupScores> scores(models.size());
  const Eigen::Map<const Eigen::VectorXd> value(problem.value.data(), rows);
  for (size_t m = 0; m < models.size(); ++m) {
    Eigen::VectorXd z = (models[m]->value - value).cwiseProduct(root_weight);
    whitening.Apply(z);
    for (Eigen::Index i = 0; i < rows; ++i)
      if (root_weight[i] > 0) scores[m][problem.group_of_row[static_cast<size_t>(i)]].Add(z[i]);
  }
  return scores;
}

}  // namespace luxfit
