#include "apps/stages/prepared_session.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "apps/stages/internal/linearize.h"
#include "apps/stages/internal/linearized_json.h"
#include "apps/stages/internal/observations_json.h"
#include "apps/stages/registration_json.h"
#include "apps/stages/stage_cache.h"
#include "apps/text/artifact.h"

namespace luxfit {
namespace {

using nlohmann::json;

Eigen::Vector3d Vector(const json& v) {
  const auto at = [&](size_t i) {
    return v.at(i).is_number() ? v.at(i).get<double>() : std::numeric_limits<double>::quiet_NaN();
  };
  return {at(0), at(1), at(2)};
}

double NumberOr(const json& value, double otherwise) {
  return value.is_number() ? value.get<double>() : otherwise;
}

// What result.json says of the luminaires, so that refits are judged by what users see.
std::vector<EstimatedLuminaire> LuminairesOf(const json& result, const LuminaireFit& fit) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<EstimatedLuminaire> found;
  for (const json& l : result.at("luminaires")) {
    EstimatedLuminaire e;
    e.id = l.at("id");
    e.position = Vector(l.at("position_m"));
    e.position_sigma_m = Vector(l.at("position_sigma_m"));
    e.flux = NumberOr(l.at("flux_lm"), NumberOr(l.value("flux_relative", json()), kUnknown));
    e.flux_sigma = NumberOr(l.at("flux_sigma_lm"), kUnknown);
    if (l.at("flux_lm").is_null() && l.contains("flux_relative")) {
      for (size_t i = 0; i < fit.parameters.size() && fit.covariance.size() > 0; ++i) {
        const Parameter& p = fit.parameters[i];
        const auto row = static_cast<Eigen::Index>(i);
        if (p.kind == ParameterKind::kLogFlux && p.name == "log flux of " + e.id)
          e.flux_sigma = e.flux * std::sqrt(fit.covariance(row, row));
      }
    }
    found.push_back(e);
  }
  return found;
}

// Photos can be laid over the mesh only where the poses are in its frame.
void ExpectSceneFrame(const Session& session, const RegisteredSession& registered) {
  if (!session.scene || registered.registration.frame.rfind("tag ", 0) != 0) return;
  throw std::runtime_error(
      session.path +
      ": registration.start: expected where three cameras or more roughly stood, since without a "
      "tag map the poses are in the frame of " +
      registered.registration.frame + ", got nothing; add start or tags.map");
}

}  // namespace

Session LinearizeKept(Session session, const SessionInputs& inputs, RunContext& context) {
  session = WithoutAmbientReadings(std::move(session), context);
  if (session.photos.empty()) return session;
  const json product = CachedStage("linearize", inputs.linearize, context,
                                   [&] { return LinearizedJson(LinearizePhotos(session, context)); });
  return WithLinearized(std::move(session), product);
}

RegisteredSession RegisterKept(const Session& linearized, const SessionInputs& inputs, RunContext& context) {
  if (linearized.photos.empty()) return {};
  return RegistrationFromJson(CachedStage("register", inputs.registration, context, [&] {
    return RegistrationJson(linearized, RegisterSession(ForRegistration(linearized), context));
  }));
}

PreparedSession PrepareSession(Session session, const SessionInputs& inputs, RunContext& context) {
  Room room = LoadRoom(session, context);
  session = LinearizeKept(std::move(session), inputs, context);
  RegisteredSession registered = RegisterKept(session, inputs, context);
  ExpectSceneFrame(session, registered);
  SessionObservations observed;
  if (!registered.registration.views.empty()) {
    observed = ObservationsFromJson(CachedStage("observe", inputs.observe, context, [&] {
      return ObservationsJson(ObserveSession(ForObservation(session), registered, room, context));
    }));
  }
  return {std::move(session), std::move(room), std::move(registered), std::move(observed.observations),
          std::move(observed.seen)};
}

PreparedSession PrepareSession(const Session& session, RunContext& context) {
  return PrepareSession(session, InputsOfStages(session, ""), context);
}

Refit RefitSession(const Session& session, const Room& room, const SessionObservations& observed,
                   const RunContext& context) {
  RunContext own;
  own.out = context.out;
  own.is_quiet = true;
  Refit refit;
  refit.fit = FitSession(session, room, observed, own);
  const json result = ResultJson(session, room, {}, refit.fit,
                                 std::vector<LuminaireFiles>(refit.fit.fit.state.luminaires.size()), own);
  refit.luminaires = LuminairesOf(result, refit.fit.fit);
  for (const Warning& warning : own.warnings) refit.warnings.push_back(warning.code);
  refit.undetermined = own.undetermined;
  const json& summary = result.at("summary");
  refit.mean_lux_error_percent = summary.at("readings_checked").get<int>() > 0
                                     ? NumberOr(summary.at("mean_abs_error_percent"), NAN)
                                     : std::numeric_limits<double>::quiet_NaN();
  return refit;
}

std::vector<EstimatedLuminaire> ReadTruth(const std::string& path) {
  const json truth = ReadJson(path);
  std::vector<EstimatedLuminaire> luminaires;
  try {
    for (const json& lamp : truth.at("lamps")) {
      EstimatedLuminaire e;
      e.id = lamp.at("id");
      e.position = Vector(lamp.at("position"));
      e.flux = lamp.at("flux_lm");
      luminaires.push_back(e);
    }
  } catch (const json::exception& e) {
    throw std::runtime_error(
        path + ": lamps: expected a list of {\"id\", \"position\", \"flux_lm\"}, got another form (" +
        e.what() + "); fixtures/office/truth.json shows it");
  }
  if (luminaires.empty())
    throw std::runtime_error(path + ": lamps: expected one luminaire or more, got none; list them");
  return luminaires;
}

}  // namespace luxfit
