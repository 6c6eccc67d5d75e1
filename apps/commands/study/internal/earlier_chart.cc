#include "apps/commands/study/internal/earlier_chart.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/text/formats/artifact.h"
#include "apps/text/input_error.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct KindOfChart {
  ChartKind kind;
  std::string command, table, artifact;  // the files' paths in OUT
  std::vector<std::string> columns;
};

const std::vector<KindOfChart>& Kinds() {
  static const std::vector<KindOfChart> kinds{
      {ChartKind::kForward,
       "luxfit chart",
       "chart.csv",
       "stages/chart.json",
       {"factor", "method", "rays", "patch_size_m", "element_size_m", "adaptive", "bounces", "solver",
        "patches", "time_s", "error_percent", "estimated_error_percent", "on_front", "automatic"}},
      {ChartKind::kFit,
       "luxfit chart --fit",
       "fit.csv",
       "stages/fit_chart.json",
       {"factor", "value", "patches", "photos", "luminaires", "observations", "processor_time_s", "usable",
        "position_mm", "flux_percent", "lux_percent"}},
      {ChartKind::kStability,
       "luxfit chart --stability",
       "stability.csv",
       "stages/stability.json",
       {"degradation", "level", "unit", "trials", "success_percent", "confident_wrong_percent",
        "warned_percent", "undetermined_percent", "intervals_held_percent", "median_position_mm",
        "median_flux_percent", "median_lux_percent"}}};
  return kinds;
}

const KindOfChart& KindOf(ChartKind kind) { return Kinds()[static_cast<size_t>(kind)]; }

std::string Expected(const KindOfChart& kind) {
  return fmt::format("expected a chart of `{}` (its folder, or {})", kind.command, kind.table);
}

// Returns the table that a folder or a file stands for.
std::string TablePathOf(const std::string& named, const KindOfChart& kind) {
  if (!fs::exists(named))
    throw InputError({named, 0}, "", Expected(kind) + ", got no such file; check the path");
  if (!fs::is_directory(named)) return named;
  const fs::path table = fs::path(named) / kind.table;
  if (fs::exists(table)) return table.string();
  std::string found = "a folder without " + kind.table;
  for (const KindOfChart& other : Kinds()) {
    if (fs::exists(fs::path(named) / other.table)) found = "one of `" + other.command + "`";
  }
  throw InputError({named, 0}, "", Expected(kind) + ", got " + found + "; give the folder of such a chart");
}

void RefuseOtherKinds(const std::string& path, const KindOfChart& kind) {
  std::ifstream file(path, std::ios::binary);
  std::string header;
  std::getline(file, header);
  for (const KindOfChart& other : Kinds()) {
    if (other.kind == kind.kind || header != fmt::format("{}", fmt::join(other.columns, ","))) continue;
    throw InputError(
        {path, 1}, "header",
        fmt::format("{}, got one of `{}`; give a chart of the same kind", Expected(kind), other.command));
  }
}

// Charts without a truth are scored against their own best fit, which is the same kind of reference.
void ExpectTruth(const json& artifact, const std::string& path, const std::string& truth_path) {
  const std::string reference = artifact.value("reference", ""),
                    hash = artifact.value("inputs", json::object()).value(reference, "");
  if (hash == (truth_path.empty() ? "" : HashFile(truth_path))) return;
  throw InputError({path, 0}, "reference",
                   fmt::format("expected errors against {}, got errors against {}; give both charts the same "
                               "--truth",
                               truth_path.empty() ? "what the undegraded session gives" : truth_path,
                               reference.empty() ? "nothing" : reference));
}

// The artifact lies beside the table, unless the table was taken out of its folder.
void ExpectSubject(const std::string& table_path, const KindOfChart& kind, const ChartSubject& subject) {
  const fs::path table = table_path;
  const fs::path path = table.parent_path() / kind.artifact;
  if (table.filename() != kind.table || !fs::exists(path)) return;
  const json artifact = ReadJson(path.string());
  try {
    const std::string session = artifact.at("session").get<std::string>();
    if (session != subject.session)
      throw InputError({path.string(), 0}, "session",
                       fmt::format("expected {}, the session to chart, got {}; give an earlier chart of the "
                                   "same session",
                                   Quoted(subject.session), Quoted(session)));
    if (kind.kind != ChartKind::kForward) ExpectTruth(artifact, path.string(), subject.truth_path);
  } catch (const json::exception& e) {
    throw InputError({path.string(), 0}, "",
                     fmt::format("expected what `{}` writes; {}", kind.command, e.what()));
  }
}

}  // namespace

const std::vector<std::string>& ColumnsOf(ChartKind kind) { return KindOf(kind).columns; }

CsvTable ReadEarlierChart(const std::string& named, const ChartSubject& subject) {
  const KindOfChart& kind = KindOf(subject.kind);
  const std::string path = TablePathOf(named, kind);
  RefuseOtherKinds(path, kind);
  ExpectSubject(path, kind, subject);
  return ReadCsvTable(path, {kind.columns, {}});
}

double CsvNumberOrNan(const CsvTable& table, const CsvRow& row, const std::string& column) {
  return CsvText(table, row, column).empty() ? NAN : CsvNumber(table, row, column);
}

}  // namespace luxfit
