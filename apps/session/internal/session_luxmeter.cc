#include "apps/session/internal/session_luxmeter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "apps/session/internal/session_states.h"
#include "apps/session/session_files.h"
#include "apps/text/formats/units.h"
#include "apps/text/name_pattern.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

constexpr char kIlluminance[] = "illuminance_lx";
constexpr std::array<const char*, 3> kIlluminanceAliases = {"lux", "illuminance_fc", "illuminance_klx"};

constexpr double kMostLx = 1e7;  // a hundred times the sun's

std::string NameOf(const SessionReading& reading) { return reading.id + "@" + reading.state; }

// Returns a number that is within the limit, in size. What is beyond is a slip: a unit, a column, a missing point.
double NumberWithin(const CsvTable& table, const CsvRow& row, const std::string& column, double limit,
                    const std::string& what) {
  const double value = CsvNumber(table, row, column);
  if (std::abs(value) <= limit) return value;
  throw CsvError(table, row, column,
                 fmt::format("expected {} of up to {:g}, got {}; correct it", what, limit,
                             Quoted(CsvText(table, row, column))));
}

SessionReading ReadRow(const CsvTable& table, const CsvRow& row, const std::vector<SessionState>& states) {
  SessionReading reading;
  reading.line = row.line;
  reading.id = CsvText(table, row, "id");
  if (reading.id.empty())
    throw CsvError(table, row, "id", "expected a name, got nothing; name the place, such as L1");
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    reading.position_m[axis] = NumberWithin(table, row, name + "_m", 1e5, "a place in m");
    reading.normal[axis] = NumberWithin(table, row, "n" + name, 1e6, "a direction");
  }
  if (reading.normal.norm() < 1e-9)
    throw CsvError(
        table, row, "nx,ny,nz",
        "expected the direction that the meter faces, got 0,0,0; 0,0,1 is a meter that lies on its back");
  reading.normal.normalize();
  reading.state = StateOfRow(table, row, states);
  if (HasColumn(table, "sensor")) reading.sensor = CsvText(table, row, "sensor");
  std::string column = kIlluminance;
  for (const char* alias : kIlluminanceAliases) column = HasColumn(table, alias) ? alias : column;
  reading.is_measured = !CsvText(table, row, column).empty();
  if (!reading.is_measured) return reading;
  const double lx_per_unit = UnitFactor(column, kIlluminance).value_or(1);
  reading.illuminance_lx =
      lx_per_unit * NumberWithin(table, row, column, kMostLx / lx_per_unit, "an illuminance");
  if (reading.illuminance_lx < 0)
    throw CsvError(table, row, column,
                   "expected >= 0, got " + Quoted(CsvText(table, row, column)) +
                       "; correct it, or leave it empty where nothing was measured");
  return reading;
}

std::vector<SessionReading> ReadReadings(const CsvTable& table, const std::vector<SessionState>& states) {
  std::vector<SessionReading> readings;
  std::map<std::string, int> line_of_name;
  for (const CsvRow& row : table.rows) {
    readings.push_back(ReadRow(table, row, states));
    const auto [first, is_new] = line_of_name.emplace(NameOf(readings.back()), row.line);
    if (!is_new)
      throw CsvError(table, row, "id",
                     "expected one reading per id and state, got " + Quoted(first->first) + " in line " +
                         std::to_string(first->second) + " too; give this one another id, or remove it");
  }
  return readings;
}

CsvTable TableOfReadings(const std::string& path) {
  std::map<std::string, std::string> alias;
  for (const char* name : kIlluminanceAliases) alias[name] = kIlluminance;
  return ReadCsvTable(
      path, {{"id", "x_m", "y_m", "z_m", "nx", "ny", "nz", "state", kIlluminance}, {"sensor"}, alias});
}

bool Matches(const SessionReading& reading, const std::string& pattern) {
  const size_t at = pattern.find('@');
  if (at == std::string::npos) return MatchesPattern(reading.id, pattern);
  return MatchesPattern(reading.id, pattern.substr(0, at)) &&
         MatchesPattern(reading.state, pattern.substr(at + 1));
}

// Returns for each reading the pattern of this list that matches it; "" where none does.
std::vector<std::string> PatternOfEach(const TomlCursor& section, const std::string& key,
                                       const std::vector<SessionReading>& readings) {
  std::vector<std::string> pattern_of(readings.size());
  const auto list = section.Find(key);
  if (!list) return pattern_of;
  for (const TomlCursor& element : list->Elements("a list of patterns such as [\"L1@all\"]")) {
    const std::string pattern = element.Text("a pattern, id or id@state");
    std::vector<std::string> names;
    bool matches_any = false;
    for (size_t i = 0; i < readings.size(); ++i) {
      names.push_back(NameOf(readings[i]));
      if (!Matches(readings[i], pattern)) continue;
      matches_any = true;
      pattern_of[i] = pattern;
      if (!readings[i].is_measured)
        throw element.Error("expected readings that were measured, got " + Quoted(names.back()) + " (line " +
                            std::to_string(readings[i].line) +
                            ") without illuminance_lx; fill it in or narrow the pattern");
    }
    if (!matches_any)
      throw element.Error("expected a pattern that matches a reading (such as " + Quoted(names.front()) +
                          "), got " + Quoted(pattern) + ", which matches none" +
                          (NearestName(pattern, names)
                               ? DidYouMean(pattern, names)
                               : "; a pattern is id or id@state, with * for any text"));
  }
  return pattern_of;
}

std::vector<SessionReading> WithRoles(const TomlCursor& section, std::vector<SessionReading> readings) {
  const std::vector<std::string> fit = PatternOfEach(section, "fit", readings);
  const std::vector<std::string> scale = PatternOfEach(section, "scale", readings);
  for (size_t i = 0; i < readings.size(); ++i) {
    if (!fit[i].empty() && !scale[i].empty())
      throw section.Require("fit", "patterns")
          .Error("expected one role for each reading, got " + Quoted(NameOf(readings[i])) +
                 " matched by fit " + Quoted(fit[i]) + " and by scale " + Quoted(scale[i]) +
                 "; narrow one of the patterns");
    if (!fit[i].empty()) readings[i].role = ReadingRole::kFit;
    if (!scale[i].empty()) readings[i].role = ReadingRole::kScale;
  }
  return readings;
}

// Returns half of the class's total error, which is expanded with k = 2.
double CommonSigma(const std::string& meter_class) {
  static const std::map<std::string, double> total_error{{"L", 0.03}, {"A", 0.05}, {"B", 0.10}, {"C", 0.20}};
  const auto at = total_error.find(meter_class);
  return at == total_error.end() ? 0 : at->second / 2;
}

SensorResponse ReadSensitivity(const std::string& path) {
  const CsvTable table = ReadCsvTable(path, {{"angle_deg", "relative"}, {}});
  constexpr double kRadPerDeg = M_PI / 180;
  std::vector<double> angle_rad, relative;
  double last_deg = 0;
  for (const CsvRow& row : table.rows) {
    const double angle_deg = CsvNumber(table, row, "angle_deg"), value = CsvNumber(table, row, "relative");
    if (angle_rad.empty() ? angle_deg != 0 : !(angle_deg > last_deg && angle_deg <= 180))
      throw CsvError(table, row, "angle_deg",
                     "expected angles that ascend from 0 to at most 180, got " +
                         Quoted(CsvText(table, row, "angle_deg")) +
                         "; sort the table, with one row an angle");
    if (value < 0 || (relative.empty() && value == 0))
      throw CsvError(table, row, "relative",
                     "expected the response relative to normal incidence, got " +
                         Quoted(CsvText(table, row, "relative")) + "; a beam at 0 degrees gives 1");
    last_deg = angle_deg;
    angle_rad.push_back(kRadPerDeg * angle_deg);
    relative.push_back(value);
  }
  if (angle_rad.size() < 2)
    throw CsvError(table, table.rows.back(), "angle_deg",
                   "expected two angles or more, got one; measure more");
  return TableResponse(std::move(angle_rad), std::move(relative));
}

}  // namespace

CsvTable ReadReadingTable(const TomlCursor& section, const std::string& folder) {
  section.ExpectKeys({"readings", "scale", "fit", "sensitivity", "class", "sensor_sigma"});
  return TableOfReadings(FindFile(section.Require("readings", "the table of readings (CSV)"), folder));
}

std::vector<SessionReading> ReadReadingsAlone(const std::string& path) {
  const CsvTable table = TableOfReadings(path);
  std::vector<SessionState> states;
  for (const CsvRow& row : table.rows) states.push_back({CsvText(table, row, "state"), {}});
  return ReadReadings(table, states);
}

SessionLuxmeter LuxmeterOf(const TomlCursor& section, const std::string& folder, const CsvTable& table,
                           const std::vector<SessionState>& states) {
  SessionLuxmeter luxmeter;
  luxmeter.readings_path = AbsolutePath(table.path);
  luxmeter.readings = WithRoles(section, ReadReadings(table, states));
  const auto sensitivity = section.Find("sensitivity");
  if (sensitivity && sensitivity->Text("\"cosine\" or a table (CSV)") != "cosine") {
    luxmeter.sensitivity_path = AbsolutePath(FindFile(*sensitivity, folder));
    luxmeter.response = ReadSensitivity(luxmeter.sensitivity_path);
  }
  if (const auto meter_class = section.Find("class"))
    luxmeter.meter_class = meter_class->OneOf({"L", "A", "B", "C"});
  luxmeter.common_sigma = CommonSigma(luxmeter.meter_class);
  if (const auto sigma = section.Find("sensor_sigma"))
    luxmeter.sensor_sigma = sigma->NumberAbove(0, "relative, such as 0.03");
  return luxmeter;
}

}  // namespace luxfit
