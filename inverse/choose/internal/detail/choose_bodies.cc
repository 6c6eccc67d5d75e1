#include "inverse/choose/internal/detail/choose_bodies.h"

#include <array>
#include <utility>

#include "forward/light/covered_surfaces.h"
#include "inverse/choose/internal/left_out.h"

namespace luxfit {
namespace {

// Bodies change the light of whole ceilings: a thousand elements tell.
constexpr int kMaxElements = 1000;

LuminaireFit FitWith(BodyPresence presence, const Room& room, const LightData& data, const LuminaireFit& fit,
                     const std::vector<ParameterPrior>& priors) {
  LightState state = fit.state;
  // One factor common to all photos does not concern bodies, and photos alone do not determine it.
  if (!data.observations.empty()) state.camera_scale_free = state.meter_scale_free = false;
  state.bodies = presence;
  FitLuminairesOptions options;
  options.covariance = false;
  options.max_outer_iterations = 1;  // from a converged fit; PredictLeftOut goes the rest of the way
  options.start_is_near = options.steps_by_direct_light = true;
  options.initial_relative_sigma = fit.relative_sigma;
  options.frozen = fit.frozen;
  options.has_texture = fit.material_texture_sigma.sum() > 0;  // as in `fit`
  return FitLuminaires(room, data, state, priors, options);
}

}  // namespace

BodyChoice ChooseBodies(const Room& room, const LightData& data, const LuminaireFit& fit,
                        const std::vector<ParameterPrior>& priors) {
  BodyChoice choice{fit.state, fit.relative_sigma, {}};
  const SubProblem problem = CutAll(room, data, kMaxElements);
  if (!problem.CanJudge() || room.sparse || FindCoveredSurfaces(room, fit.state.luminaires).empty())
    return choice;

  std::array<LuminaireFit, 2> fits{FitWith(BodyPresence::kWhenOn, room, problem.data, fit, priors),
                                   FitWith(BodyPresence::kAlways, room, problem.data, fit, priors)};
  std::array<LeftOutPrediction, 2> left_out;
  for (size_t i = 0; i < fits.size(); ++i)
    left_out[i] = PredictLeftOut(room, problem.data, fits[i], priors, problem.fold_of_row);
  choice.presence =
      ChooseDetail({"there where on", "always there"}, ScoreTogether(problem, {&left_out[0], &left_out[1]}));
  LuminaireFit& chosen = fits[static_cast<size_t>(choice.presence.chosen)];
  choice.state = std::move(chosen.state);
  choice.state.camera_scale_free = fit.state.camera_scale_free;
  choice.state.meter_scale_free = fit.state.meter_scale_free;
  choice.relative_sigma = chosen.relative_sigma;
  return choice;
}

}  // namespace luxfit
