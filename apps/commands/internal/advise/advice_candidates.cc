#include "apps/commands/internal/advise/advice_candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "apps/text/formats/csv_table.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

// Returns a place of a table, which lies in the room.
Eigen::Vector3d PlaceOf(const AdviceSetting& setting, const CsvTable& table, const CsvRow& row) {
  Eigen::Vector3d place(CsvNumber(table, row, "x_m"), CsvNumber(table, row, "y_m"),
                        CsvNumber(table, row, "z_m"));
  const Eigen::AlignedBox3d box = setting.room.scene.Bounds();
  if (setting.room.scene.facets.empty() || box.contains(place)) return place;
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

int StateOf(const AdviceSetting& setting, const CsvTable& table, const CsvRow& row) {
  const std::string& name = CsvText(table, row, "state");
  const int state = StateIndex(setting.session, name);
  if (state >= 0) return state;
  std::vector<std::string> known;
  for (const SessionState& s : setting.session.states) known.push_back(s.id);
  throw CsvError(table, row, "state", ExpectedOneOf(known, name));
}

void AddPhotosOfTable(const AdviceSetting& setting, const std::string& path, AdviceGiven& given) {
  const CsvTable table = ReadCsvTable(path, {{"id", "x_m", "y_m", "z_m", "dx", "dy", "dz"}, {"state"}});
  for (const CsvRow& row : table.rows) {
    const int view = static_cast<int>(given.views.size());
    given.views.push_back(ViewFrom(CsvText(table, row, "id"), PlaceOf(setting, table, row),
                                   DirectionOf(table, row, "d"), *setting.camera));
    if (HasColumn(table, "state")) {
      given.photos.push_back({view, StateOf(setting, table, row)});
      continue;
    }
    for (size_t s = 0; s < setting.session.states.size(); ++s)
      given.photos.push_back({view, static_cast<int>(s)});
  }
}

void AddPhotosOfGrid(const AdviceSetting& setting, AdviceGiven& given) {
  const std::vector<SurveyedTag>& tags = setting.session.tags.survey;
  for (AdviceView& view : ViewsToTake(setting.room, *setting.camera, tags, setting.spacing_m)) {
    const int index = static_cast<int>(given.views.size());
    given.views.push_back(std::move(view));
    for (size_t s = 0; s < setting.session.states.size(); ++s)
      given.photos.push_back({index, static_cast<int>(s)});
  }
}

// Returns whether the run used a reading of that place and state.
bool IsUsed(const AdviceSetting& setting, const ReadingCandidate& candidate) {
  constexpr double kSamePlaceM = 1e-3;
  const std::vector<SessionReading>& readings = setting.session.luxmeter.readings;
  return setting.has_run && std::any_of(readings.begin(), readings.end(), [&](const SessionReading& r) {
           return r.role != ReadingRole::kCheck && StateIndex(setting.session, r.state) == candidate.state &&
                  (r.position_m - candidate.sensor.position).norm() < kSamePlaceM;
         });
}

void AddReadingsOfTable(const AdviceSetting& setting, const std::string& path, AdviceGiven& given) {
  // Values that were read do not count: the table may be the session's own.
  const CsvTable table =
      ReadCsvTable(path, {{"id", "x_m", "y_m", "z_m", "nx", "ny", "nz", "state"},
                          {"illuminance_lx", "lux", "illuminance_fc", "illuminance_klx", "sensor"}});
  for (const CsvRow& row : table.rows) {
    const int state = StateOf(setting, table, row);
    const ReadingCandidate candidate{
        CsvText(table, row, "id"),
        {PlaceOf(setting, table, row), DirectionOf(table, row, "n"), setting.session.luxmeter.response},
        state};
    if (!IsUsed(setting, candidate)) given.readings.push_back(candidate);
  }
}

void AddReadingsOfGrid(const AdviceSetting& setting, AdviceGiven& given) {
  for (Sensor& place : PlacesToRead(setting.room, setting.spacing_m)) {
    place.response = setting.session.luxmeter.response;
    for (size_t s = 0; s < given.dimming.size(); ++s)
      given.readings.push_back({"", place, static_cast<int>(s)});
  }
}

}  // namespace

void AddCandidates(const AdviceSetting& setting, const AdviceCandidates& candidates, AdviceGiven& given) {
  if (!candidates.photo_table.empty() && !setting.camera)
    throw std::runtime_error(
        "--photos: expected a run with photos, whose camera a photo would be taken with; "
        "give --only readings");
  if (candidates.photos && setting.camera) {
    if (candidates.photo_table.empty()) AddPhotosOfGrid(setting, given);
    if (!candidates.photo_table.empty()) AddPhotosOfTable(setting, candidates.photo_table, given);
  }
  if (candidates.readings) {
    if (candidates.reading_table.empty()) AddReadingsOfGrid(setting, given);
    if (!candidates.reading_table.empty()) AddReadingsOfTable(setting, candidates.reading_table, given);
  }
}

void AddPredicted(const Session& session, AdviceGiven& given) {
  for (const SessionReading& reading : session.luxmeter.readings)
    given.predicted.push_back({reading.id + "@" + reading.state,
                               {reading.position_m, reading.normal, session.luxmeter.response},
                               StateIndex(session, reading.state)});
}

}  // namespace luxfit
