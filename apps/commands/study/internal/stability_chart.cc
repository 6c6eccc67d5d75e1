#include "apps/commands/study/internal/stability_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "apps/charts/xy_chart_svg.h"
#include "apps/commands/study/internal/earlier_chart.h"
#include "apps/text/formats/csv_text.h"

namespace luxfit {
namespace {

double Percent(int count, int of) { return of > 0 ? 100.0 * count / of : NAN; }

std::vector<StabilityRow> RowsOf(const DegradationResult& result) {
  std::vector<StabilityRow> rows;
  rows.reserve(result.levels.size());
  for (const LevelResult& l : result.levels) {
    const LevelSummary& s = l.summary;
    rows.push_back({result.degradation.name, l.level, result.degradation.unit, s.trials,
                    100 * s.SuccessRate(), 100 * s.ConfidentWrongRate(), Percent(l.warned, s.trials),
                    Percent(l.undetermined, s.trials), Percent(s.intervals_held, s.intervals),
                    1e3 * s.median_position_error_m, 100 * s.median_flux_error, l.median_lux_error_percent});
  }
  return rows;
}

XySeries Series(const std::vector<StabilityRow>& rows, const std::string& name, double StabilityRow::*value) {
  XySeries series{name, {}, {}, true};
  for (const StabilityRow& row : rows) series.points.push_back({row.level, row.*value});
  return series;
}

XyChart RatesChart(const std::vector<StabilityRow>& rows, const XyAxis& level) {
  XyChart chart;
  chart.x = level;
  chart.y = {"of the trials, %", false, -4, 104};
  chart.series = {Series(rows, "success", &StabilityRow::success_percent),
                  Series(rows, "wrong, and sure of it", &StabilityRow::confident_wrong_percent),
                  Series(rows, "intervals that hold", &StabilityRow::intervals_held_percent),
                  Series(rows, "warned, or no result", &StabilityRow::warned_percent)};
  return chart;
}

XyChart ErrorsChart(const std::vector<StabilityRow>& rows, const XyAxis& level) {
  XyChart chart;
  chart.title = "Median error";
  chart.subtitle = "median over luminaires, then over trials";
  chart.x = level;
  chart.y = {"mm, %", true, {}, {}};
  chart.series = {Series(rows, "position, mm", &StabilityRow::median_position_mm),
                  Series(rows, "flux, %", &StabilityRow::median_flux_percent),
                  Series(rows, "readings, % of their mean", &StabilityRow::median_lux_percent)};
  return chart;
}

std::string TrialsText(const StabilityPicture& picture, const std::vector<StabilityRow>& before) {
  std::string text = fmt::format("{} trials a level", picture.trials);
  if (!before.empty() && before.front().trials != picture.trials)
    text += fmt::format(" ({}: {})", picture.names.before, before.front().trials);
  return text;
}

std::string Cell(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : ""; }

}  // namespace

std::string StabilitySvg(const DegradationResult& result, const StabilityPicture& picture) {
  const std::vector<StabilityRow> rows = RowsOf(result);
  std::vector<StabilityRow> before;
  std::copy_if(picture.before.begin(), picture.before.end(), std::back_inserter(before),
               [&](const StabilityRow& row) { return row.degradation == result.degradation.name; });
  const XyAxis level{result.degradation.axis, result.degradation.is_log, {}, {}};
  XyChart rates = WithBefore(RatesChart(rows, level), RatesChart(before, level), picture.names);
  rates.title = picture.session + ": " + result.degradation.name;
  rates.subtitle = TrialsText(picture, before) + "; success: every luminaire within 50 mm and 10 %";
  return XyChartsSvg(
      {rates, WithBefore(ErrorsChart(rows, level), ErrorsChart(before, level), picture.names)});
}

std::string StabilityCsv(const std::vector<DegradationResult>& results) {
  std::string text = CsvLine(ColumnsOf(ChartKind::kStability));
  for (const DegradationResult& result : results) {
    for (const StabilityRow& r : RowsOf(result))
      text +=
          fmt::format("{},{:g},{},{},{},{},{},{},{},{},{},{}\n", r.degradation, r.level, r.unit, r.trials,
                      Cell(r.success_percent), Cell(r.confident_wrong_percent), Cell(r.warned_percent),
                      Cell(r.undetermined_percent), Cell(r.intervals_held_percent),
                      Cell(r.median_position_mm), Cell(r.median_flux_percent), Cell(r.median_lux_percent));
  }
  return text;
}

std::vector<StabilityRow> StabilityRowsOf(const CsvTable& table) {
  std::vector<StabilityRow> rows;
  rows.reserve(table.rows.size());
  for (const CsvRow& row : table.rows) {
    const auto figure = [&](const char* column) { return CsvNumberOrNan(table, row, column); };
    rows.push_back({CsvText(table, row, "degradation"), CsvNumber(table, row, "level"),
                    CsvText(table, row, "unit"), static_cast<int>(CsvNumber(table, row, "trials")),
                    figure("success_percent"), figure("confident_wrong_percent"), figure("warned_percent"),
                    figure("undetermined_percent"), figure("intervals_held_percent"),
                    figure("median_position_mm"), figure("median_flux_percent"),
                    figure("median_lux_percent")});
  }
  return rows;
}

}  // namespace luxfit
