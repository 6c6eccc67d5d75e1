#include "apps/commands/internal/advice_given.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "apps/export/fit_uncertainty.h"
#include "apps/text/formats/csv_table.h"
#include "apps/text/input_error.h"
#include "apps/text/suggest.h"

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

// Returns a place of a table, which lies in the room.
Eigen::Vector3d PlaceOf(const FittedRoom& fitted, const CsvTable& table, const CsvRow& row) {
  Eigen::Vector3d place(CsvNumber(table, row, "x_m"), CsvNumber(table, row, "y_m"),
                        CsvNumber(table, row, "z_m"));
  const Eigen::AlignedBox3d box = fitted.room.scene.Bounds();
  if (fitted.room.scene.facets.empty() || box.contains(place)) return place;
  throw CsvError(
      table, row, "x_m",
      fmt::format("expected a place within the room ({:g} to {:g}, {:g} to {:g}, {:g} to {:g} m), got "
                  "{:g}, {:g}, {:g}; correct it",
                  box.min().x(), box.max().x(), box.min().y(), box.max().y(), box.min().z(), box.max().z(),
                  place.x(), place.y(), place.z()));
}

Eigen::Vector3d DirectionOf(const CsvTable& table, const CsvRow& row, const std::string& prefix) {
  const Eigen::Vector3d direction(CsvNumber(table, row, prefix + "x"), CsvNumber(table, row, prefix + "y"),
                                  CsvNumber(table, row, prefix + "z"));
  if (!(direction.norm() > 0))
    throw CsvError(table, row, prefix + "x", "expected a direction, got 0,0,0; 0,0,1 is upwards");
  return direction.normalized();
}

int StateOf(const FittedRoom& fitted, const CsvTable& table, const CsvRow& row) {
  const std::string& name = CsvText(table, row, "state");
  const int state = StateIndex(fitted.session, name);
  if (state >= 0) return state;
  std::vector<std::string> known;
  for (const SessionState& s : fitted.session.states) known.push_back(s.id);
  throw CsvError(table, row, "state", ExpectedOneOf(known, name));
}

void AddPhotosOfTable(const FittedRoom& fitted, const std::string& path, AdviceGiven& given) {
  const CsvTable table = ReadCsvTable(path, {{"id", "x_m", "y_m", "z_m", "dx", "dy", "dz"}, {"state"}});
  for (const CsvRow& row : table.rows) {
    const int view = static_cast<int>(given.views.size());
    given.views.push_back(ViewFrom(CsvText(table, row, "id"), PlaceOf(fitted, table, row),
                                   DirectionOf(table, row, "d"), fitted.registered.cameras.front()));
    if (HasColumn(table, "state")) {
      given.photos.push_back({view, StateOf(fitted, table, row)});
      continue;
    }
    for (size_t s = 0; s < fitted.session.states.size(); ++s)
      given.photos.push_back({view, static_cast<int>(s)});
  }
}

void AddPhotosOfGrid(const FittedRoom& fitted, AdviceGiven& given) {
  const std::vector<SurveyedTag>& tags = fitted.session.tags.survey;
  for (AdviceView& view : ViewsToTake(fitted.room, fitted.registered.cameras.front(), tags)) {
    const int index = static_cast<int>(given.views.size());
    given.views.push_back(std::move(view));
    for (size_t s = 0; s < fitted.session.states.size(); ++s)
      given.photos.push_back({index, static_cast<int>(s)});
  }
}

// Returns whether the fit used a reading of that place and state.
bool IsUsed(const FittedRoom& fitted, const ReadingCandidate& candidate) {
  constexpr double kSamePlaceM = 1e-3;
  const std::vector<SessionReading>& readings = fitted.session.luxmeter.readings;
  return std::any_of(readings.begin(), readings.end(), [&](const SessionReading& r) {
    return r.role != ReadingRole::kCheck && StateIndex(fitted.session, r.state) == candidate.state &&
           (r.position_m - candidate.sensor.position).norm() < kSamePlaceM;
  });
}

void AddReadingsOfTable(const FittedRoom& fitted, const std::string& path, AdviceGiven& given) {
  // Values that were read do not count: the table may be the session's own.
  const CsvTable table =
      ReadCsvTable(path, {{"id", "x_m", "y_m", "z_m", "nx", "ny", "nz", "state"},
                          {"illuminance_lx", "lux", "illuminance_fc", "illuminance_klx", "sensor"}});
  for (const CsvRow& row : table.rows) {
    const int state = StateOf(fitted, table, row);
    const ReadingCandidate candidate{
        CsvText(table, row, "id"),
        {PlaceOf(fitted, table, row), DirectionOf(table, row, "n"), fitted.session.luxmeter.response},
        state};
    if (!IsUsed(fitted, candidate)) given.readings.push_back(candidate);
  }
}

void AddReadingsOfGrid(const FittedRoom& fitted, AdviceGiven& given) {
  for (Sensor& place : PlacesToRead(fitted.room)) {
    place.response = fitted.session.luxmeter.response;
    for (size_t s = 0; s < given.dimming.size(); ++s)
      given.readings.push_back({"", place, static_cast<int>(s)});
  }
}

void AddPredicted(const FittedRoom& fitted, AdviceGiven& given) {
  for (const SessionReading& reading : fitted.session.luxmeter.readings)
    given.predicted.push_back({reading.id + "@" + reading.state,
                               {reading.position_m, reading.normal, fitted.session.luxmeter.response},
                               StateIndex(fitted.session, reading.state)});
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
  AddPredicted(fitted, given);
  const bool has_camera = !fitted.registered.cameras.empty();
  if (!candidates.photo_table.empty() && !has_camera)
    throw std::runtime_error(
        "--photos: expected a run with photos, whose camera a photo would be taken with; "
        "give --only readings");
  if (candidates.photos && has_camera) {
    if (candidates.photo_table.empty()) AddPhotosOfGrid(fitted, given);
    if (!candidates.photo_table.empty()) AddPhotosOfTable(fitted, candidates.photo_table, given);
  }
  if (candidates.readings) {
    if (candidates.reading_table.empty()) AddReadingsOfGrid(fitted, given);
    if (!candidates.reading_table.empty()) AddReadingsOfTable(fitted, candidates.reading_table, given);
  }
  return advice;
}

}  // namespace luxfit
