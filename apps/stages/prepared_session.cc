#include "apps/stages/prepared_session.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "apps/stages/check/session_check.h"
#include "apps/stages/linearize/linearize.h"
#include "apps/stages/linearize/linearized_json.h"
#include "apps/stages/linearize/photo_store.h"
#include "apps/stages/observe/found_furniture.h"
#include "apps/stages/observe/observations_json.h"
#include "apps/stages/register/registration_json.h"
#include "apps/stages/stage_cache.h"
#include "apps/text/formats/artifact.h"
#include "inverse/check/luxmeter_check.h"
#include "inverse/fit/fit_room.h"

namespace luxfit {
namespace {

using nlohmann::json;

Eigen::Vector3d VectorOrNan(const json& v) {
  const auto at = [&](size_t i) {
    return v.at(i).is_number() ? v.at(i).get<double>() : std::numeric_limits<double>::quiet_NaN();
  };
  return {at(0), at(1), at(2)};
}

// Photos match the mesh only where the poses are in its frame.
void ExpectSceneFrame(const Session& session, const RegisteredSession& registered) {
  if (!session.scene || registered.registration.frame.rfind("tag ", 0) != 0) return;
  throw std::runtime_error(
      session.path +
      ": registration.start: expected where three cameras or more roughly stood, since without a "
      "tag map the poses are in the frame of " +
      registered.registration.frame + ", got nothing; add start or tags.map");
}

// Returns the mean error of the readings that only check; NaN where there are none.
double MeanCheckError(const std::vector<LuminaireReading>& readings, const RoomFit& fit) {
  std::vector<CheckedReading> checked;
  const std::vector<PredictedReading> predictions = PredictedReadings(fit);
  for (size_t i = 0; i < predictions.size(); ++i) {
    const SessionReading& given = readings[i].given;
    const bool is_checked = given.role == ReadingRole::kCheck && given.is_measured && !readings[i].is_outside;
    if (!is_checked || !predictions[i].is_known) continue;
    checked.push_back({readings[i].illuminance_lx, predictions[i].illuminance_lx,
                       fit.data.readings[i].sigma_lx, predictions[i].sigma_lx});
  }
  return checked.empty() ? std::numeric_limits<double>::quiet_NaN()
                         : SummarizeLuxmeter(checked).mean_abs_error_percent;
}

void LeaveOutReadings(const std::set<int>& lines, std::vector<LuminaireReading>& readings) {
  for (LuminaireReading& reading : readings) reading.is_outside = lines.count(reading.given.line) > 0;
}

void LeaveOutPhotos(const std::vector<MisplacedPhoto>& misplaced, LinearizedPhotos& photos) {
  const auto is_misplaced = [&](const LinearizedPhoto& photo) {
    return std::any_of(misplaced.begin(), misplaced.end(), [&](const MisplacedPhoto& m) {
      return m.view == photo.view && m.state == photo.state;
    });
  };
  photos.photos.erase(std::remove_if(photos.photos.begin(), photos.photos.end(), is_misplaced),
                      photos.photos.end());
}

// Makes the room anew with the furniture that photos show.
void ChangeFurniture(const FurnitureChange& change, Session& session, Room& room, RunContext& context) {
  if (change.IsEmpty()) return;
  session.scene->furniture = change.boxes;
  session.scene->moves = change.moves;
  session.scene->walls = change.walls;
  session.scene->parts = change.parts;
  RunContext changed;
  changed.is_quiet = true;
  room = LoadRoom(session, changed);
  // Findings on the mesh stay; choices that count patches are those of the changed room.
  for (const Choice& choice : changed.choices) {
    for (Choice& said : context.choices)
      if (said.what == choice.what) said = choice;
  }
}

// Judges readings anew in a room whose walls moved: a floor that the mesh has too high buried them.
void CheckReadingsAgain(const Session& session, const Room& room, std::vector<LuminaireReading>& readings,
                        RunContext& context) {
  const auto is_of_readings = [](const Warning& warning) { return warning.code == "reading_outside"; };
  std::vector<Warning>& said = context.warnings;
  said.erase(std::remove_if(said.begin(), said.end(), is_of_readings), said.end());
  const SessionCheck check = CheckSession(session, room.rays);
  std::copy_if(check.warnings.begin(), check.warnings.end(), std::back_inserter(said), is_of_readings);
  LeaveOutReadings(check.readings.lines, readings);
}

// Adds the furniture that photos show to the inputs of observe, which depends on it.
SessionInputs WithFurniture(SessionInputs inputs, const Session& session) {
  if (!session.scene) return inputs;
  const SessionScene& scene = *session.scene;
  if (!(scene.furniture.empty() && scene.moves.empty() && scene.walls.empty() && scene.parts.empty()))
    inputs.observe["found furniture"] =
        HashText(BoxesJson(scene.furniture).dump() + MovesJson(scene.moves).dump() +
                 WallsJson(scene.walls).dump() + PartsJson(scene.parts).dump());
  return inputs;
}

}  // namespace

LinearizedSession LinearizeKept(const Session& session, const SessionInputs& inputs, RunContext& context) {
  std::vector<LuminaireReading> readings = ReadingsWithoutAmbient(session, context);
  if (session.photos.empty()) return {LinearizePhotos(session, context), std::move(readings)};
  if (const auto kept = KeptProduct("linearize", inputs.linearize, context))
    return {LinearizedFromJson(session, *kept), std::move(readings)};
  const StageMark mark(context);
  LinearizedPhotos photos = LinearizePhotos(session, context);
  KeepProduct("linearize", inputs.linearize, context, mark, LinearizedJson(photos));
  return {std::move(photos), std::move(readings)};
}

RegisteredSession RegisterKept(const Session& session, const LinearizedPhotos& photos,
                               const SessionInputs& inputs, RunContext& context) {
  if (photos.photos.empty()) return {};
  if (const auto kept = KeptProduct("register", inputs.registration, context))
    return RegistrationFromJson(*kept);
  const StageMark mark(context);
  RegisteredSession registered = RegisterSession(ForRegistration(session), photos, context);
  KeepProduct("register", inputs.registration, context, mark, RegistrationJson(session, registered));
  return registered;
}

Evidence ObserveKept(const Session& session, const LinearizedPhotos& photos,
                     const RegisteredSession& registered, const Room& room, const SessionInputs& inputs,
                     RunContext& context) {
  if (registered.registration.views.empty()) return {};
  if (const auto kept = KeptProduct("observe", inputs.observe, context)) {
    Evidence observed = ObservationsFromJson(*kept);
    observed.pose_covariance = PoseErrorsOf(registered.registration);
    return observed;
  }
  const StageMark mark(context);
  Evidence observed = ObserveSession(ForObservation(session), photos, registered, room, context);
  KeepProduct("observe", inputs.observe, context, mark, ObservationsJson(observed));
  return observed;
}

PreparedSession PrepareSession(const Session& given, const SessionInputs& inputs, RunContext& context) {
  Room room = LoadRoom(given, context);
  Session session = OnSurfaceOf(room, given);
  LinearizedSession linearized = LinearizeKept(session, inputs, context);
  const SessionCheck check = CheckSession(session, room.rays);
  context.warnings.insert(context.warnings.end(), check.warnings.begin(), check.warnings.end());
  // Said at once, too: who sees it may stop the run and correct the table.
  for (const Warning& warning : check.warnings)
    if (!context.is_quiet) std::fprintf(stderr, "%-9s %s\n", "check", warning.message.c_str());
  LeaveOutReadings(check.readings.lines, linearized.readings);
  context.photos = std::make_shared<PhotoStore>();
  RegisteredSession registered = RegisterKept(session, linearized.photos, inputs, context);
  ExpectSceneFrame(session, registered);
  LeaveOutPhotos(registered.misplaced, linearized.photos);
  KeptFurniture found = FurnitureKept(session, linearized.photos, registered, room, inputs, context);
  const FurnitureChange& change = found.change;
  ChangeFurniture(change, session, room, context);
  if (!change.walls.empty()) CheckReadingsAgain(session, room, linearized.readings, context);
  Evidence observed =
      ObserveKept(session, linearized.photos, registered, room, WithFurniture(inputs, session), context);
  context.photos.reset();
  return {session,
          std::move(linearized),
          std::move(room),
          std::move(registered),
          std::move(found.mesh_as_if),
          std::move(observed)};
}

PreparedSession PrepareSession(const Session& session, RunContext& context) {
  return PrepareSession(session, InputsOfStages(session, ""), context);
}

Evidence ObserveKeptPhotos(const PreparedSession& prepared,
                           const std::function<bool(const LinearizedPhoto&)>& is_kept, RunContext& context) {
  const Session& session = prepared.session;
  LinearizedPhotos photos = prepared.linearized.photos;
  std::vector<LinearizedPhoto>& list = photos.photos;
  list.erase(std::remove_if(list.begin(), list.end(),
                            [&](const LinearizedPhoto& photo) {
                              const auto state = static_cast<size_t>(StateIndex(session, photo.state));
                              return !IsAmbient(session, session.states[state]) && !is_kept(photo);
                            }),
             list.end());
  return ObserveSession(session, photos, prepared.registered, prepared.room, context);
}

Evidence Thinned(Evidence observed, int max_elements) {
  observed.observations = ThinElements(observed.observations, max_elements);
  return observed;
}

Refit RefitSession(const Session& session, const LinearizedSession& linearized, const Room& room,
                   const Evidence& observed, const RunContext& context) {
  RunContext own;
  own.out = context.out;
  own.is_quiet = true;
  Refit refit;
  refit.fit = FitSession(session, linearized, room, observed, own);
  refit.luminaires = EstimatedLuminaires(refit.fit);
  refit.warnings = own.warnings;
  refit.undetermined = own.IsUndetermined();
  refit.mean_lux_error_percent = MeanCheckError(linearized.readings, refit.fit);
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
