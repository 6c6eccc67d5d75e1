#include "inverse/choose/internal/left_out.h"

#include <algorithm>
#include <cmath>

#include "inverse/model/internal/light_model.h"

namespace luxfit {
namespace {

bool OnAlone(const Eigen::VectorXd& dimming, int luminaire) {
  return dimming[luminaire] > 0 && dimming.sum() == dimming[luminaire];
}

LightState AloneOrOthersHeld(const LightState& start, int luminaire, bool alone) {
  LightState state = start;
  state.albedo_free.assign(state.albedo_free.size(), false);
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

void AddObservations(const Room& room, const LightData& data, const std::vector<bool>& state_used,
                     int max_elements, SubProblem& problem) {
  std::vector<Observation> own;
  for (const Observation& o : data.observations) {
    if (state_used[static_cast<size_t>(o.state)]) own.push_back(o);
  }
  for (const Observation& o : ThinElements(own, max_elements)) {
    const int patch = room.patches.elements[static_cast<size_t>(o.element)].patch;
    problem.all.observations.push_back(o);
    problem.group_of_row.push_back(room.patches.patches[static_cast<size_t>(patch)].facet);
    problem.left_out.push_back(IsLeftOut(patch));
    problem.value.push_back(o.relative_luminance);
    problem.variance.push_back(o.variance);
    if (!IsLeftOut(patch)) problem.fit.observations.push_back(o);
  }
}

void AddReadings(const LightData& data, const std::vector<bool>& state_used, SubProblem& problem) {
  for (size_t i = 0; i < data.readings.size(); ++i) {
    Reading reading = data.readings[i];
    if (!state_used[static_cast<size_t>(reading.state)] || !reading.used) continue;
    const int group = static_cast<int>(problem.all.readings.size());
    const bool out = IsLeftOut(group);
    problem.all.readings.push_back(reading);
    problem.group_of_row.push_back(group);
    problem.left_out.push_back(out);
    problem.value.push_back(reading.illuminance_lx);
    problem.variance.push_back(0);
    reading.used = !out;
    problem.fit.readings.push_back(reading);
  }
}

}  // namespace

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
  problem.state = AloneOrOthersHeld(start, luminaire, alone);
  problem.luminaire = alone ? 0 : luminaire;
  std::vector<bool> state_used;
  for (const Eigen::VectorXd& dimming : data.dimming) {
    state_used.push_back(alone ? OnAlone(dimming, luminaire) : dimming[luminaire] > 0);
    problem.all.dimming.push_back(alone ? Eigen::VectorXd::Constant(1, dimming[luminaire]).eval() : dimming);
  }
  problem.all.indirect_is_held = data.indirect_is_held;
  problem.fit.dimming = problem.all.dimming;
  problem.fit.indirect_is_held = data.indirect_is_held;
  if (photos) {
    AddObservations(room, data, state_used, max_elements, problem);
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
  problem.all.dimming = data.dimming;
  problem.all.indirect_is_held = data.indirect_is_held;
  problem.fit = problem.all;
  if (data.observations.empty()) {
    AddReadings(data, every_state, problem);
  } else {
    AddObservations(room, data, every_state, max_elements, problem);
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
  options.visibility_order = 2;
  const LuminaireFit fit = FitLuminaires(room, problem.fit, state, problem.priors, options);
  LightModel model(room, problem.all);
  model.FreezeVisibility(fit.state, options.visibility_order);
  return {fit.state.luminaires[k], free, model.Predict(fit.state, {}, false).value, fit.relative_sigma,
          fit.effective_parts};
}

GroupScores ScoreGroups(const SubProblem& problem, const Eigen::VectorXd& predicted, double relative_sigma) {
  GroupScores scores;
  for (size_t i = 0; i < problem.left_out.size(); ++i) {
    if (!problem.left_out[i]) continue;
    const double value = problem.value[i];
    const double variance = std::pow(relative_sigma * value, 2) + problem.variance[i];
    const double z = (predicted[static_cast<Eigen::Index>(i)] - value) / std::sqrt(variance);
    scores[problem.group_of_row[i]].Add(z);
  }
  return scores;
}

}  // namespace luxfit
