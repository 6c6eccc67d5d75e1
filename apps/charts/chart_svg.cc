#include "apps/charts/chart_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "apps/charts/chart_axis.h"
#include "apps/charts/svg.h"
#include "forward/factors/form_factors.h"

namespace luxfit {
namespace {

constexpr double kPointChartWidthPx = 980, kPointChartHeightPx = 640;
constexpr double kPointChartLeftPx = 76, kPointChartRightPx = 770, kPointChartTopPx = 64,
                 kPointChartBottomPx = 570;
constexpr double kLeastPercent = 1e-3;  // a logarithmic axis has no 0

// Leaves a tenth of a decade free on either side.
ChartAxis AxisFor(double least, double most, double from_px, double to_px) {
  return {least / 1.3, most * 1.3, from_px, to_px, true};
}

struct PointStyle {
  const char* colour;
  SvgMarkShape mark;
};

// Okabe and Ito's colours differ for any colour vision, and marks differ without colours. A method takes the
// style of its place among FormFactorMethods(): a new one at the end leaves the others theirs.
PointStyle StyleOf(FormFactorMethod method) {
  constexpr PointStyle kMethodStyles[] = {
      {"#d55e00", SvgMarkShape::kDisc},    {"#0072b2", SvgMarkShape::kSquare},
      {"#009e73", SvgMarkShape::kDiamond}, {"#009e73", SvgMarkShape::kTriangle},
      {"#56b4e9", SvgMarkShape::kDiamond}, {"#cc79a7", SvgMarkShape::kCross},
      {"#b09a00", SvgMarkShape::kSquare},  {"#888888", SvgMarkShape::kTriangle},
      {"#000000", SvgMarkShape::kCross},   {"#000000", SvgMarkShape::kDisc}};
  const auto place = static_cast<size_t>(&OpsOf(method) - FormFactorMethods().data());
  return kMethodStyles[place % std::size(kMethodStyles)];
}

std::string Mark(const PointStyle& style, double x, double y, double r) {
  return SvgMark(style.mark, style.colour, x, y, r);
}

std::string Axes(const ChartAxis& x, const ChartAxis& y) {
  std::string text;
  const std::string grid = " stroke=\"#e4e4e4\"", centred = " text-anchor=\"middle\"",
                    right = " text-anchor=\"end\"";
  for (const double value : x.Ticks())
    text += SvgLine(x(value), kPointChartTopPx, x(value), kPointChartBottomPx, grid) +
            SvgText(x(value), kPointChartBottomPx + 18, fmt::format("{:g}", value), centred);
  for (const double value : y.Ticks())
    text += SvgLine(kPointChartLeftPx, y(value), kPointChartRightPx, y(value), grid) +
            SvgText(kPointChartLeftPx - 8, y(value) + 4, fmt::format("{:g}", value), right);
  const std::string frame = " stroke=\"#333\"";
  text += SvgLine(kPointChartLeftPx, kPointChartBottomPx, kPointChartRightPx, kPointChartBottomPx, frame) +
          SvgLine(kPointChartLeftPx, kPointChartTopPx, kPointChartLeftPx, kPointChartBottomPx, frame);
  text += SvgText((kPointChartLeftPx + kPointChartRightPx) / 2, kPointChartBottomPx + 44,
                  "time for the whole prediction, s", centred);
  const double middle = (kPointChartTopPx + kPointChartBottomPx) / 2;
  text += SvgText(20, middle, "error of the illuminance, rms over sensors and luminaires, %",
                  fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 20 {:.1f})\"", middle));
  return text;
}

// Steps right and down: the least error within each time.
std::string Front(const std::vector<ChartPoint>& points, const ChartAxis& x, const ChartAxis& y) {
  std::vector<ChartPoint> front;
  std::copy_if(points.begin(), points.end(), std::back_inserter(front),
               [](const ChartPoint& p) { return p.on_front; });
  if (front.empty()) return "";
  std::sort(front.begin(), front.end(),
            [](const ChartPoint& a, const ChartPoint& b) { return a.time_s < b.time_s; });
  std::string path = fmt::format("M{:.1f} {:.1f}", x(front[0].time_s), y(front[0].error_percent));
  for (const ChartPoint& point : front)
    path += fmt::format("H{:.1f}V{:.1f}", x(point.time_s), y(point.error_percent));
  path += fmt::format("H{:.1f}", kPointChartRightPx);
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#333\" stroke-width=\"1.5\"/>\n", path);
}

std::string Automatic(const ChartPoint& point, const ChartAxis& x, const ChartAxis& y) {
  const double px = x(point.time_s), py = y(point.error_percent);
  const std::string bounces = point.bounces ? fmt::format("{} bounces", *point.bounces) : "all bounces";
  const std::string label = fmt::format("automatic: {} {:g} to {:g} m, {} rays, {}", ToString(point.method),
                                        point.patch_size_m, point.element_size_m, point.rays, bounces);
  const std::string figures = fmt::format("{:.2g} s, error {:.2g} %, estimated {:.2g} %", point.time_s,
                                          point.error_percent, point.estimated_error_percent.value_or(0));
  // The legend stands at the lower left, below the front, where no point can lie.
  const double tx = kPointChartLeftPx + 12, ty = kPointChartBottomPx - 34;
  const std::string style =
      " font-weight=\"bold\" stroke=\"white\" stroke-width=\"4\" paint-order=\"stroke\"";
  return SvgCircle(px, py, 11, " fill=\"none\" stroke=\"#d00000\" stroke-width=\"2.5\"") +
         SvgLine(px, py + 11, tx + 60, ty - 18, " stroke=\"#d00000\"") + SvgText(tx, ty - 4, label, style) +
         SvgText(tx, ty + 13, figures, style);
}

std::string Legend(const Chart& chart) {
  std::string text;
  double y = kPointChartTopPx + 8;
  const double x = kPointChartRightPx + 24;
  for (const FormFactorOps& ops : FormFactorMethods()) {
    const bool shown = std::any_of(chart.points.begin(), chart.points.end(),
                                   [&](const ChartPoint& p) { return p.method == ops.method; });
    if (!shown) continue;
    text += Mark(StyleOf(ops.method), x, y, 5) + SvgText(x + 14, y + 4, ops.name);
    y += 22;
  }
  text += Mark(StyleOf(chart.points.front().method), x, y, 2.5) + SvgText(x + 14, y + 4, "bounces, solvers");
  text += SvgLine(x - 8, y + 22, x + 8, y + 22, " stroke=\"#333\" stroke-width=\"1.5\"") +
          SvgText(x + 14, y + 26, "Pareto front");
  text += SvgLine(x - 8, y + 44, x + 8, y + 44, " stroke=\"#777\" stroke-dasharray=\"5 4\"") +
          SvgText(x + 14, y + 48, "noise of the reference");
  text += SvgCircle(x, y + 66, 7, " fill=\"none\" stroke=\"#d00000\" stroke-width=\"2.5\"") +
          SvgText(x + 14, y + 70, "automatic choice");
  return text;
}

}  // namespace

std::string ChartSvg(const Chart& chart, const std::string& title) {
  if (chart.points.empty()) return "";
  double least_s = 1e9, most_s = 0, least = chart.reference.sigma_percent, most = 0;
  for (const ChartPoint& point : chart.points) {
    least_s = std::min(least_s, point.time_s);
    most_s = std::max(most_s, point.time_s);
    least = std::min(least, point.error_percent);
    most = std::max(most, point.error_percent);
  }
  least = std::max(least, kLeastPercent);
  const ChartAxis x =
      AxisFor(std::max(least_s, 1e-6), std::max(most_s, 2e-6), kPointChartLeftPx, kPointChartRightPx);
  constexpr double kRoomForLabel = 3;  // below the least error
  const ChartAxis y =
      AxisFor(least / kRoomForLabel, std::max(most, 2 * least), kPointChartBottomPx, kPointChartTopPx);
  std::string body =
      SvgText(kPointChartLeftPx, 26, title, " font-size=\"17\" font-weight=\"bold\"") +
      SvgText(kPointChartLeftPx, 46,
              fmt::format("each point one way to compute the same illuminance; reference: light "
                          "tracer, {} paths a sensor, ± {:.2g} %",
                          chart.reference.paths_per_sensor, chart.reference.sigma_percent),
              " fill=\"#555\"") +
      Axes(x, y);
  const double floor = y(chart.reference.sigma_percent);
  body += SvgLine(kPointChartLeftPx, floor, kPointChartRightPx, floor,
                  " stroke=\"#777\" stroke-dasharray=\"5 4\"");
  body += Front(chart.points, x, y);
  for (const ChartPoint& point : chart.points) {
    const bool small = point.factor == "bounces" || point.factor == "solver";
    body += Mark(StyleOf(point.method), x(point.time_s), y(point.error_percent), small ? 2.5 : 4.5);
  }
  for (const ChartPoint& point : chart.points) {
    if (point.automatic) body += Automatic(point, x, y);
  }
  return SvgDocument(kPointChartWidthPx, kPointChartHeightPx, body + Legend(chart));
}

}  // namespace luxfit
