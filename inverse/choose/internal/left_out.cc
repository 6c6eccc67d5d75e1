#include "inverse/choose/internal/left_out.h"

#include <algorithm>
#include <cmath>

#include "inverse/model/internal/outline_block.h"
#include "inverse/select/internal/spatial_blocks.h"

namespace luxfit {
namespace {

constexpr int kFolds = 5;
constexpr int kBlocksPerFold = 8;

bool OnAlone(const Eigen::VectorXd& dimming, int luminaire) {
  return dimming[luminaire] > 0 && dimming.sum() == dimming[luminaire];
}

LightState AloneOrOthersHeld(const LightState& start, int luminaire, bool alone, bool with_albedo) {
  LightState state = start;
  if (!with_albedo) state.albedo_free.assign(state.albedo_free.size(), false);
  state.camera_scale_free = false;
  state.meter_scale_free = false;
  const size_t k = static_cast<size_t>(luminaire);
  if (alone) {
    state.luminaires = {start.luminaires[k]};
    state.free = {start.free[k]};
  } else {
    for (size_t j = 0; j < state.free.size(); ++j) {
      if (j != k) state.free[j] = {false, false, false, false, false};
    }
  }
  return state;
}

void CutIntoFolds(const std::vector<Eigen::Vector3d>& place_of_row, SubProblem& problem) {
  problem.fold_of_row = SpatialBlocks(place_of_row, kFolds * kBlocksPerFold);
  for (int& fold : problem.fold_of_row) fold %= kFolds;
}

void AddObservations(const Room& room, const LightData& data, const std::vector<bool>& state_used,
                     int max_elements, SubProblem& problem) {
  std::vector<Observation> own;
  for (const Observation& o : data.observations) {
    if (state_used[static_cast<size_t>(o.state)]) own.push_back(o);
  }
  problem.data.observations = ThinElements(own, max_elements);
  std::vector<Eigen::Vector3d> places;
  for (const Observation& o : problem.data.observations) {
    const int patch = room.patches.elements[static_cast<size_t>(o.element)].patch;
    places.push_back(room.patches.patches[static_cast<size_t>(patch)].center);
    problem.group_of_row.push_back(room.patches.patches[static_cast<size_t>(patch)].facet);
    problem.value.push_back(o.relative_luminance);
    problem.variance.push_back(o.variance);
  }
  CutIntoFolds(places, problem);
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
  problem.group_of_row = SpatialBlocks(places, static_cast<int>(places.size()));
  CutIntoFolds(places, problem);
}

// Adds an outline. A fold leaves whole views out.
void AddOutline(const SeenOutline& outline, int luminaire, SubProblem& problem) {
  constexpr int kFirstGroup = 1 << 28;  // apart from those of facets
  problem.data.outlines.push_back({luminaire, outline});
  for (size_t i = 0; i < outline.rays.size(); ++i) {
    problem.group_of_row.push_back(kFirstGroup + outline.view);
    problem.fold_of_row.push_back(outline.view % kFolds);
    problem.value.push_back(0);
    problem.variance.push_back(kOutlineSigmaPx * kOutlineSigmaPx);
  }
}

}  // namespace

bool SubProblem::CanJudge() const {
  return std::any_of(fold_of_row.begin(), fold_of_row.end(), [](int fold) { return fold > 0; });
}

SubProblem MakeSubProblem(const Room& room, const LightData& data, const LightState& start, int luminaire,
                          const std::vector<ParameterPrior>& priors, int max_elements) {
  SubProblem problem;
  const auto is_alone = [&](int state) {
    return OnAlone(data.dimming[static_cast<size_t>(state)], luminaire);
  };
  const bool photos = !data.observations.empty();
  const bool alone = photos ? std::any_of(data.observations.begin(), data.observations.end(),
                                          [&](const Observation& o) { return is_alone(o.state); })
                            : std::any_of(data.readings.begin(), data.readings.end(),
                                          [&](const Reading& r) { return r.used && is_alone(r.state); });
  problem.state = AloneOrOthersHeld(start, luminaire, alone, photos && data.indirect_is_held);
  problem.luminaire = alone ? 0 : luminaire;
  std::vector<bool> state_used;
  for (const Eigen::VectorXd& dimming : data.dimming) {
    state_used.push_back(alone ? OnAlone(dimming, luminaire) : dimming[luminaire] > 0);
    problem.data.dimming.push_back(alone ? Eigen::VectorXd::Constant(1, dimming[luminaire]).eval() : dimming);
  }
  problem.data.indirect_is_held = data.indirect_is_held;
  if (photos) {
    AddObservations(room, data, state_used, max_elements, problem);
    for (const LuminaireOutline& outline : data.outlines) {
      if (outline.luminaire == luminaire && state_used[static_cast<size_t>(outline.seen.state)])
        AddOutline(outline.seen, problem.luminaire, problem);
    }
  } else {
    AddReadings(data, state_used, problem);
  }
  for (ParameterPrior prior : priors) {
    if (prior.kind == ParameterKind::kLogSensorGain) problem.priors.push_back(prior);
    if (prior.kind != ParameterKind::kLuminaire && prior.kind != ParameterKind::kLogFlux) continue;
    if (prior.index != luminaire) continue;
    prior.index = problem.luminaire;
    problem.priors.push_back(prior);
  }
  return problem;
}

SubProblem CutAll(const Room& room, const LightData& data, int max_elements) {
  SubProblem problem;
  const std::vector<bool> every_state(data.dimming.size(), true);
  problem.data.dimming = data.dimming;
  problem.data.indirect_is_held = data.indirect_is_held;
  if (data.observations.empty()) {
    AddReadings(data, every_state, problem);
  } else {
    AddObservations(room, data, every_state, max_elements, problem);
    for (const LuminaireOutline& outline : data.outlines)
      AddOutline(outline.seen, outline.luminaire, problem);
  }
  return problem;
}

FittedModel FitModel(const Room& room, const SubProblem& problem, const Luminaire& start,
                     const FreeQuantities& free, const FitEffort& effort) {
  const size_t k = static_cast<size_t>(problem.luminaire);
  LightState state = problem.state;
  state.luminaires[k] = start;
  state.free[k] = free;
  FitLuminairesOptions options;
  options.covariance = free.table_sigma > 0 || free.emission_sigma > 0;  // gives the effective parameters
  options.max_outer_iterations = effort.max_outer_iterations;
  options.max_inner_iterations = effort.max_inner_iterations;
  options.visibility_order = kComparedVisibilityOrder;
  const LuminaireFit fit = FitLuminaires(room, problem.data, state, problem.priors, options);
  return {
      fit.state.luminaires[k], free,
      PredictLeftOut(room, problem.data, fit, problem.priors, problem.fold_of_row, kComparedVisibilityOrder),
      fit.effective_parts};
}

std::vector<GroupScores> ScoreTogether(const SubProblem& problem,
                                       const std::vector<const LeftOutPrediction*>& models) {
  double relative_sigma = 1;
  for (const LeftOutPrediction* model : models)
    relative_sigma = std::min(relative_sigma, model->relative_sigma);
  std::vector<GroupScores> scores(models.size());
  for (size_t i = 0; i < problem.value.size(); ++i) {
    const bool counts = std::all_of(models.begin(), models.end(),
                                    [&](const LeftOutPrediction* model) { return model->is_smooth[i]; });
    if (!counts) continue;
    const double value = problem.value[i];
    const double sigma = std::sqrt(std::pow(relative_sigma * value, 2) + problem.variance[i]);
    for (size_t m = 0; m < models.size(); ++m) {
      const double z = (models[m]->value[static_cast<Eigen::Index>(i)] - value) / sigma;
      scores[m][problem.group_of_row[i]].Add(z);
    }
  }
  return scores;
}

}  // namespace luxfit
