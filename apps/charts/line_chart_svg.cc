#include "apps/charts/line_chart_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/charts/chart_axis.h"
#include "apps/charts/svg.h"

namespace luxfit {
namespace {

constexpr double kWidthPx = 900, kHeightPx = 520;
constexpr double kLeftPx = 76, kRightPx = 660, kTopPx = 64, kBottomPx = 456;

struct Style {
  const char* colour;
  SvgMarkShape mark;
};

// Colours of Okabe and Ito.
Style StyleOf(std::size_t series) {
  constexpr Style kStyles[] = {{"#d55e00", SvgMarkShape::kDisc},     {"#0072b2", SvgMarkShape::kSquare},
                               {"#009e73", SvgMarkShape::kDiamond},  {"#cc79a7", SvgMarkShape::kCross},
                               {"#56b4e9", SvgMarkShape::kTriangle}, {"#b09a00", SvgMarkShape::kSquare},
                               {"#888888", SvgMarkShape::kDisc},     {"#000000", SvgMarkShape::kCross}};
  return kStyles[series % std::size(kStyles)];
}

bool IsDrawn(const LineChart& chart, const Eigen::Vector2d& point) {
  return point.allFinite() && (!chart.x.is_log || point.x() > 0) && (!chart.y.is_log || point.y() > 0);
}

ChartAxis AxisFor(const LineChart& chart, int coordinate, double from_px, double to_px) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const LineSeries& series : chart.series) {
    for (const Eigen::Vector2d& point : series.points) {
      if (!IsDrawn(chart, point)) continue;
      least = std::min(least, point[coordinate]);
      most = std::max(most, point[coordinate]);
    }
  }
  const LineChartAxis& wanted = coordinate == 0 ? chart.x : chart.y;
  if (wanted.is_log) {
    least /= 1.3;
    most *= 1.3;
  } else {
    const double room = most > least ? 0.04 * (most - least) : 1;
    least -= room;
    most += room;
  }
  return {wanted.min.value_or(least), wanted.max.value_or(most), from_px, to_px, wanted.is_log};
}

std::string Axes(const LineChart& chart, const ChartAxis& x, const ChartAxis& y) {
  const std::string grid = " stroke=\"#e4e4e4\"", frame = " stroke=\"#333\"",
                    centred = " text-anchor=\"middle\"";
  std::string text;
  for (const double value : x.Ticks()) {
    text += SvgLine(x(value), kTopPx, x(value), kBottomPx, grid) +
            SvgText(x(value), kBottomPx + 18, fmt::format("{:.4g}", value), centred);
  }
  for (const double value : y.Ticks()) {
    text += SvgLine(kLeftPx, y(value), kRightPx, y(value), grid) +
            SvgText(kLeftPx - 8, y(value) + 4, fmt::format("{:.4g}", value), " text-anchor=\"end\"");
  }
  const double middle = (kTopPx + kBottomPx) / 2;
  return text + SvgLine(kLeftPx, kBottomPx, kRightPx, kBottomPx, frame) +
         SvgLine(kLeftPx, kTopPx, kLeftPx, kBottomPx, frame) +
         SvgText((kLeftPx + kRightPx) / 2, kBottomPx + 42, chart.x.label, centred) +
         SvgText(20, middle, chart.y.label,
                 fmt::format("{} transform=\"rotate(-90 20 {:.1f})\"", centred, middle));
}

std::string Draw(const LineChart& chart, std::size_t index, const ChartAxis& x, const ChartAxis& y) {
  const LineSeries& series = chart.series[index];
  const Style style = StyleOf(index);
  std::string path, marks;
  bool pen_is_down = false;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const Eigen::Vector2d& point = series.points[i];
    const bool drawn = IsDrawn(chart, point);
    if (drawn) {
      path += fmt::format("{}{:.1f} {:.1f}", pen_is_down ? "L" : "M", x(point.x()), y(point.y()));
      marks += SvgMark(style.mark, style.colour, x(point.x()), y(point.y()), 4);
      if (i < series.labels.size())
        marks +=
            SvgText(x(point.x()) + 7, y(point.y()) - 6, series.labels[i], " font-size=\"11\" fill=\"#555\"");
    }
    pen_is_down = drawn;
  }
  if (!series.is_joined || path.empty()) return marks;
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", path,
                     style.colour) +
         marks;
}

// Draws the chart with its upper left corner at the origin; empty where no point can be drawn.
std::string ChartBody(const LineChart& chart) {
  const bool any = std::any_of(chart.series.begin(), chart.series.end(), [&chart](const LineSeries& series) {
    return std::any_of(series.points.begin(), series.points.end(),
                       [&chart](const Eigen::Vector2d& point) { return IsDrawn(chart, point); });
  });
  if (!any) return "";
  const ChartAxis x = AxisFor(chart, 0, kLeftPx, kRightPx), y = AxisFor(chart, 1, kBottomPx, kTopPx);
  std::string body = SvgText(kLeftPx, 26, chart.title, " font-size=\"17\" font-weight=\"bold\"") +
                     SvgText(kLeftPx, 46, chart.subtitle, " fill=\"#555\"") + Axes(chart, x, y);
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const Style style = StyleOf(i);
    const double legend_y = kTopPx + 8 + 22 * static_cast<double>(i);
    body += Draw(chart, i, x, y) + SvgMark(style.mark, style.colour, kRightPx + 24, legend_y, 5) +
            SvgText(kRightPx + 38, legend_y + 4, chart.series[i].name);
  }
  return body;
}

}  // namespace

std::string LineChartSvg(const LineChart& chart) {
  const std::string body = ChartBody(chart);
  return body.empty() ? "" : SvgDocument(kWidthPx, kHeightPx, body);
}

std::string StackedLineChartsSvg(const std::vector<LineChart>& charts) {
  std::string bodies;
  double top_px = 0;
  for (const LineChart& chart : charts) {
    const std::string body = ChartBody(chart);
    if (body.empty()) continue;
    bodies += fmt::format("<g transform=\"translate(0 {:.0f})\">\n{}</g>\n", top_px, body);
    top_px += kHeightPx;
  }
  return bodies.empty() ? "" : SvgDocument(kWidthPx, top_px, bodies);
}

}  // namespace luxfit
