#include "apps/commands/study/internal/forward_chart_table.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "apps/commands/study/internal/earlier_chart.h"
#include "apps/text/formats/csv_text.h"
#include "apps/text/suggest.h"
#include "forward/factors/form_factors.h"

namespace luxfit {
namespace {

FormFactorMethod MethodOf(const CsvTable& table, const CsvRow& row) {
  const std::string& name = CsvText(table, row, "method");
  const std::optional<FormFactorMethod> method = FormFactorMethodFrom(name);
  if (method) return *method;
  std::vector<std::string> known;
  known.reserve(FormFactorMethods().size());
  for (const FormFactorOps& ops : FormFactorMethods()) known.emplace_back(ops.name);
  throw CsvError(table, row, "method", ExpectedOneOf(known, name));
}

}  // namespace

std::string BouncesOf(const ChartPoint& point) {
  return point.bounces ? std::to_string(*point.bounces) : "all";
}

std::string ForwardChartCsv(const std::vector<ChartPoint>& points) {
  std::string text = CsvLine(ColumnsOf(ChartKind::kForward));
  for (const ChartPoint& p : points) {
    text += fmt::format("{},{},{},{:g},{:g},{:d},{},{},{},{:.4g},{:.4g},{},{:d},{:d}\n", p.factor,
                        ToString(p.method), p.rays, p.patch_size_m, p.element_size_m, p.adaptive,
                        BouncesOf(p), ToString(p.solver), p.patches, p.time_s, p.error_percent,
                        p.estimated_error_percent ? fmt::format("{:.4g}", *p.estimated_error_percent) : "",
                        p.on_front, p.automatic);
  }
  return text;
}

std::vector<ChartPoint> ForwardPointsOf(const CsvTable& table) {
  std::vector<ChartPoint> points;
  points.reserve(table.rows.size());
  for (const CsvRow& row : table.rows) {
    ChartPoint point;
    point.factor = CsvText(table, row, "factor");
    point.method = MethodOf(table, row);
    point.time_s = CsvNumber(table, row, "time_s");
    point.error_percent = CsvNumber(table, row, "error_percent");
    point.on_front = CsvNumber(table, row, "on_front") != 0;
    point.automatic = CsvNumber(table, row, "automatic") != 0;
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace luxfit
