#include "apps/commands/study/internal/stability_chart.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "apps/charts/xy_chart_svg.h"

namespace luxfit {
namespace {

XySeries Series(const DegradationResult& result, const std::string& name,
                const std::function<double(const LevelResult&)>& value) {
  XySeries series{name, {}, {}, true};
  for (const LevelResult& level : result.levels) series.points.push_back({level.level, value(level)});
  return series;
}

double Percent(int count, int of) { return of > 0 ? 100.0 * count / of : NAN; }

std::string Cell(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : ""; }

}  // namespace

std::string StabilitySvg(const DegradationResult& result, const std::string& session, int trials) {
  XyChart rates, errors;
  rates.title = session + ": " + result.degradation.name;
  rates.subtitle = fmt::format("{} trials a level; success: every luminaire within 50 mm and 10 %", trials);
  rates.x = {result.degradation.axis, result.degradation.is_log, {}, {}};
  rates.y = {"of the trials, %", false, -4, 104};
  rates.series = {
      Series(result, "success", [](const LevelResult& l) { return 100 * l.summary.SuccessRate(); }),
      Series(result, "wrong, and sure of it",
             [](const LevelResult& l) { return 100 * l.summary.ConfidentWrongRate(); }),
      Series(result, "intervals that hold",
             [](const LevelResult& l) { return Percent(l.summary.intervals_held, l.summary.intervals); }),
      Series(result, "warned, or no result",
             [](const LevelResult& l) { return Percent(l.warned, l.summary.trials); })};
  errors.title = "Median error";
  errors.subtitle = "median over luminaires, then over trials";
  errors.x = rates.x;
  errors.y = {"mm, %", true, {}, {}};
  errors.series = {
      Series(result, "position, mm",
             [](const LevelResult& l) { return 1e3 * l.summary.median_position_error_m; }),
      Series(result, "flux, %", [](const LevelResult& l) { return 100 * l.summary.median_flux_error; }),
      Series(result, "readings, % of their mean",
             [](const LevelResult& l) { return l.median_lux_error_percent; })};
  return XyChartsSvg({rates, errors});
}

std::string StabilityCsv(const std::vector<DegradationResult>& results) {
  std::string text =
      "degradation,level,unit,trials,success_percent,confident_wrong_percent,warned_percent,"
      "undetermined_percent,intervals_held_percent,median_position_mm,median_flux_percent,"
      "median_lux_percent\n";
  for (const DegradationResult& result : results) {
    for (const LevelResult& l : result.levels) {
      const LevelSummary& s = l.summary;
      text += fmt::format("{},{:g},{},{},{},{},{},{},{},{},{},{}\n", result.degradation.name, l.level,
                          result.degradation.unit, s.trials, Cell(100 * s.SuccessRate()),
                          Cell(100 * s.ConfidentWrongRate()), Cell(Percent(l.warned, s.trials)),
                          Cell(Percent(l.undetermined, s.trials)),
                          Cell(Percent(s.intervals_held, s.intervals)), Cell(1e3 * s.median_position_error_m),
                          Cell(100 * s.median_flux_error), Cell(l.median_lux_error_percent));
    }
  }
  return text;
}

}  // namespace luxfit
