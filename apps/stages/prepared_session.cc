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
#include "inverse/check/luxmeter_check.h"
#include "inverse/fit/fit_outcome.h"

namespace luxfit {
namespace {

using nlohmann::json;

Eigen::Vector3d VectorOrNan(const json& v) {
  const auto at = [&](size_t i) {
    return v.at(i).is_number() ? v.at(i).get<double>() : std::numeric_limits<double>::quiet_NaN();
  };
  return {at(0), at(1), at(2)};
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

// Of the readings that only check; NaN: there are none.
double MeanCheckError(const Session& session, const RoomFit& fit) {
  std::vector<CheckedReading> checked;
  const std::vector<PredictedReading> predictions = PredictedReadings(fit);
  for (size_t i = 0; i < predictions.size(); ++i) {
    const SessionReading& given = session.luxmeter.readings[i];
    if (given.role != ReadingRole::kCheck || !given.is_measured || !predictions[i].is_known) continue;
    checked.push_back({given.illuminance_lx, predictions[i].illuminance_lx, fit.data.readings[i].sigma_lx,
                       predictions[i].sigma_lx});
  }
  return checked.empty() ? std::numeric_limits<double>::quiet_NaN()
                         : SummarizeLuxmeter(checked).mean_abs_error_percent;
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
  refit.luminaires = EstimatedLuminaires(refit.fit);
  for (const Warning& warning : own.warnings) refit.warnings.push_back(warning.code);
  refit.undetermined = own.undetermined;
  refit.mean_lux_error_percent = MeanCheckError(session, refit.fit);
  return refit;
}

std::vector<EstimatedLuminaire> ReadTruth(const std::string& path) {
  const json truth = ReadJson(path);
  std::vector<EstimatedLuminaire> luminaires;
  try {
    for (const json& lamp : truth.at("lamps")) {
      EstimatedLuminaire e;
      e.id = lamp.at("id");
      e.position = VectorOrNan(lamp.at("position"));
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
