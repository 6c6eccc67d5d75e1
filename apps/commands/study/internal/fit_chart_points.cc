#include "apps/commands/study/internal/fit_chart_points.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "apps/commands/study/internal/earlier_chart.h"
#include "apps/text/formats/csv_text.h"

namespace luxfit {
namespace {

std::string CellOrEmpty(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : ""; }

}  // namespace

std::string FitChartCsv(const std::vector<FitPoint>& points) {
  std::string text = CsvLine(ColumnsOf(ChartKind::kFit));
  for (const FitPoint& p : points)
    text += fmt::format("{},{:g},{},{},{},{},{:.3g},{:d},{},{},{}\n", p.factor, p.value, p.patches, p.photos,
                        p.luminaires, p.observations, p.time_s, p.is_usable, CellOrEmpty(p.position_mm),
                        CellOrEmpty(p.flux_percent), CellOrEmpty(p.lux_percent));
  return text;
}

std::vector<FitPoint> FitPointsOf(const CsvTable& table) {
  std::vector<FitPoint> points;
  points.reserve(table.rows.size());
  for (const CsvRow& row : table.rows) {
    const auto count = [&](const char* column) { return static_cast<int>(CsvNumber(table, row, column)); };
    FitPoint point;
    point.factor = CsvText(table, row, "factor");
    point.value = CsvNumber(table, row, "value");
    point.patches = count("patches");
    point.photos = count("photos");
    point.luminaires = count("luminaires");
    point.observations = count("observations");
    point.time_s = CsvNumber(table, row, "processor_time_s");
    point.is_usable = CsvNumber(table, row, "usable") != 0;
    point.position_mm = CsvNumberOrNan(table, row, "position_mm");
    point.flux_percent = CsvNumberOrNan(table, row, "flux_percent");
    point.lux_percent = CsvNumberOrNan(table, row, "lux_percent");
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace luxfit
