#include "apps/commands/internal/advise/advice_given.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/export/fit_uncertainty.h"
#include "apps/text/input_error.h"

namespace luxfit {
namespace {

using nlohmann::json;

// Returns whether the result has no flux of the luminaire, although it has a scale.
bool LacksFlux(const json& result, const std::string& luminaire) {
  return std::any_of(result.at("luminaires").begin(), result.at("luminaires").end(), [&](const json& l) {
    return l.at("id") == luminaire && l.at("flux_lm").is_null() && !l.contains("flux_relative");
  });
}

FitUncertainty KnownFit(const FittedRoom& fitted) {
  const std::string& out = fitted.out;
  FitUncertainty fit = ReadFitUncertainty(out);
  if (fit.covariance.size() == 0)
    throw InputError({out + "/stages/fit.json", 0}, "covariance",
                     "expected the covariance of a whole fit, got none; run `luxfit run` again with a larger "
                     "--budget");
  for (size_t p = 0; p < fit.parameters.size(); ++p) {
    const ParameterId& id = fit.parameters[p];
    if (id.kind == ParameterKind::kLogFlux && LacksFlux(*fitted.result, id.owner))
      fit.is_determined[p] = false;
  }
  return fit;
}

bool IsAlone(const Eigen::VectorXd& dimming, Eigen::Index luminaire) {
  return dimming[luminaire] > 0 && (dimming.array() > 0).count() == 1;
}

void AddStates(const FittedRoom& fitted, SessionAdvice& advice) {
  for (const SessionState& state : fitted.session.states) {
    advice.states.push_back({state.id, false});
    advice.given.dimming.push_back(DimmingOf(fitted, state.id));
  }
  const auto count = static_cast<Eigen::Index>(fitted.luminaires.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::vector<Eigen::VectorXd>& known = advice.given.dimming;
    if (std::any_of(known.begin(), known.end(), [&](const Eigen::VectorXd& d) { return IsAlone(d, k); }))
      continue;
    advice.states.push_back({fitted.luminaires[static_cast<size_t>(k)].id + " alone", true});
    advice.given.dimming.emplace_back(Eigen::VectorXd::Unit(count, k));
  }
}

void AddTaken(const FittedRoom& fitted, AdviceGiven& given) {
  for (const RegisteredView& view : fitted.registered.registration.views) {
    const int index = static_cast<int>(given.views.size());
    given.views.push_back(
        {view.view, view.cam_from_world, fitted.registered.cameras[static_cast<size_t>(view.camera)]});
    for (const SessionPhoto& photo : fitted.session.photos) {
      if (photo.view == view.view) given.taken.push_back({index, StateIndex(fitted.session, photo.state)});
    }
  }
}

}  // namespace

SessionAdvice SessionAdviceOf(const FittedRoom& fitted, const AdviceCandidates& candidates) {
  SessionAdvice advice;
  AdviceGiven& given = advice.given;
  given.luminaires = fitted.luminaires;
  given.albedo = fitted.albedo;
  given.camera_scale = fitted.camera_scale > 0 ? fitted.camera_scale : 1;
  given.is_absolute = fitted.is_absolute;
  given.fit = KnownFit(fitted);
  given.meter_common_sigma = fitted.session.luxmeter.common_sigma;
  AddStates(fitted, advice);
  AddTaken(fitted, given);
  AddPredicted(fitted.session, given);
  const std::vector<Camera>& cameras = fitted.registered.cameras;
  AddCandidates(
      {fitted.session, fitted.room, cameras.empty() ? std::nullopt : std::optional(cameras.front()), true},
      candidates, given);
  return advice;
}

}  // namespace luxfit
