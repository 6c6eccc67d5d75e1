#include "apps/charts/xy_chart_svg.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <limits>
#include <sstream>
#include <utility>

#include "apps/charts/chart_axis.h"

namespace luxfit {
namespace {

constexpr double kWidthPx = 960, kHeightPx = 560;
constexpr double kLeftPx = 76, kRightPx = 720, kTopPx = 64, kBottomPx = 496;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool IsDrawn(const XyChart& chart, const Eigen::Vector2d& point) {
  return point.allFinite() && (!chart.x.is_log || point.x() > 0) && (!chart.y.is_log || point.y() > 0);
}

ChartAxis AxisFor(const XyChart& chart, int coordinate, double from_px, double to_px) {
  double least = kInfinity, most = -kInfinity;
  for (const XySeries& series : chart.series) {
    for (const Eigen::Vector2d& point : series.points) {
      if (!IsDrawn(chart, point)) continue;
      least = std::min(least, point[coordinate]);
      most = std::max(most, point[coordinate]);
    }
  }
  const XyAxis& wanted = coordinate == 0 ? chart.x : chart.y;
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

std::string Axes(const XyChart& chart, const ChartAxis& x, const ChartAxis& y) {
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

struct Drawn {
  const XySeries& series;
  XyStyle style;
  std::vector<std::optional<Eigen::Vector2d>> px;  // nothing where a point cannot be drawn
};

// Returns the series that have points to draw.
std::vector<Drawn> DrawnOf(const XyChart& chart, const ChartAxis& x, const ChartAxis& y) {
  std::vector<Drawn> all;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const XySeries& series = chart.series[i];
    Drawn drawn{series, series.style.value_or(XyStyleAt(i)), {}};
    bool has_points = false;
    drawn.px.reserve(series.points.size());
    for (const Eigen::Vector2d& p : series.points) {
      drawn.px.push_back(IsDrawn(chart, p) ? std::optional(Eigen::Vector2d(x(p.x()), y(p.y())))
                                           : std::nullopt);
      has_points = has_points || drawn.px.back();
    }
    if (has_points) all.push_back(std::move(drawn));
  }
  return all;
}

std::string Line(const Drawn& drawn) {
  if (!drawn.series.is_joined) return "";
  std::string path;
  bool pen_is_down = false;
  for (const auto& px : drawn.px) {
    if (px) path += fmt::format("{}{:.1f} {:.1f}", pen_is_down ? "L" : "M", px->x(), px->y());
    pen_is_down = px.has_value();
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"{}/>\n", path,
                     drawn.style.colour, drawn.style.is_dashed ? " stroke-dasharray=\"5 4\"" : "");
}

std::string Marks(const Drawn& drawn) {
  const XyStyle& style = drawn.style;
  const std::string ring = fmt::format(" fill=\"none\" stroke=\"{}\" stroke-width=\"2.5\"", style.colour);
  std::string text;
  for (const auto& px : drawn.px) {
    if (!px || style.radius_px == 0) continue;
    text += style.mark ? SvgMark(*style.mark, style.colour, px->x(), px->y(), style.radius_px)
                       : SvgCircle(px->x(), px->y(), style.radius_px, ring);
  }
  return text;
}

using Box = Eigen::AlignedBox2d;

// Returns the place beside a point, upper right if possible, that covers least of what is taken.
Box LabelBox(const Eigen::Vector2d& px, double width_px, const std::vector<Box>& taken) {
  constexpr double kHeight = 11, kApart = 7;
  constexpr int kSides[][2] = {{1, -1}, {1, 1}, {-1, -1}, {-1, 1}, {1, 0}, {-1, 0}, {0, -1}, {0, 1}};
  const Box plot(Eigen::Vector2d(kLeftPx, kTopPx - kHeight), Eigen::Vector2d(kRightPx + kApart, kBottomPx));
  Box best;
  double least = kInfinity;
  for (const auto& [right, down] : kSides) {
    const Eigen::Vector2d size(width_px, kHeight);
    const Eigen::Vector2d middle =
        px + Eigen::Vector2d(right * (kApart + width_px / 2), down * (right == 0 ? 13 : 9));
    const Box box(middle - size / 2, middle + size / 2);
    const auto shared = [&box](const Box& other) {
      const Box both = box.intersection(other);
      return both.isEmpty() ? 0 : both.volume();
    };
    double covered = box.volume() - shared(plot);
    for (const Box& other : taken) covered += shared(other);
    if (covered < least) best = box;
    least = std::min(least, covered);
  }
  return best;
}

// Writes the text at the side of its box that is next to the point, because its width is not known exactly.
std::string Label(const std::string& label, const Box& box, const Eigen::Vector2d& px) {
  const char* anchor = box.min().x() > px.x() ? "start" : box.max().x() < px.x() ? "end" : "middle";
  return SvgText(std::clamp(px.x(), box.min().x(), box.max().x()), box.max().y() - 1, label,
                 fmt::format(" font-size=\"11\" fill=\"#555\" stroke=\"white\" stroke-width=\"3\" "
                             "paint-order=\"stroke\" text-anchor=\"{}\"",
                             anchor));
}

std::string Labels(const std::vector<Drawn>& all) {
  constexpr double kCharacterPx = 6.2;
  std::vector<Box> taken;
  for (const Drawn& drawn : all) {
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(drawn.style.radius_px);
    for (const auto& px : drawn.px) {
      if (px) taken.emplace_back(*px - half, *px + half);
    }
  }
  std::string text;
  for (const Drawn& drawn : all) {
    for (std::size_t i = 0; i < std::min(drawn.px.size(), drawn.series.labels.size()); ++i) {
      const std::string& label = drawn.series.labels[i];
      if (!drawn.px[i] || label.empty()) continue;
      taken.push_back(LabelBox(*drawn.px[i], kCharacterPx * static_cast<double>(label.size()), taken));
      text += Label(label, taken.back(), *drawn.px[i]);
    }
  }
  return text;
}

// Draws an entry of the legend with its middle at `y_px`. Returns the place of the next one.
double LegendEntry(const XySeries& series, const XyStyle& style, double y_px, std::string& text) {
  constexpr double kX = kRightPx + 24;
  const Eigen::Vector2d middle(kX, y_px), half(9, 0);
  text += Line({series, style, {middle - half, middle + half}}) + Marks({series, style, {middle}});
  std::istringstream lines(series.name);
  for (std::string line; std::getline(lines, line); y_px += 17) text += SvgText(kX + 16, y_px + 4, line);
  return y_px + 5;
}

std::string Legend(const std::vector<XySeries>& keys, const std::vector<Drawn>& all) {
  std::string text;
  double y = kTopPx + 8;
  for (std::size_t i = 0; i < keys.size(); ++i)
    y = LegendEntry(keys[i], keys[i].style.value_or(XyStyleAt(i)), y, text);
  if (!keys.empty()) y += 8;
  for (const Drawn& drawn : all) {
    if (!drawn.series.name.empty()) y = LegendEntry(drawn.series, drawn.style, y, text);
  }
  return text;
}

// Draws the chart with its upper left corner at the origin; empty where no point can be drawn.
std::string ChartBody(const XyChart& chart) {
  const ChartAxis x = AxisFor(chart, 0, kLeftPx, kRightPx), y = AxisFor(chart, 1, kBottomPx, kTopPx);
  const std::vector<Drawn> all = DrawnOf(chart, x, y);
  if (all.empty()) return "";
  std::string lines, marks;
  for (const Drawn& drawn : all) {
    lines += Line(drawn);
    marks += Marks(drawn);
  }
  return SvgText(kLeftPx, 26, chart.title, " font-size=\"17\" font-weight=\"bold\"") +
         SvgText(kLeftPx, 46, chart.subtitle, " fill=\"#555\"") + Axes(chart, x, y) + lines + Labels(all) +
         marks + Legend(chart.keys, all);
}

}  // namespace

// Colours of Okabe and Ito, which differ for any colour vision. A series that is added at the end leaves the
// others theirs.
XyStyle XyStyleAt(std::size_t place) {
  constexpr std::pair<const char*, SvgMarkShape> kStyles[] = {
      {"#d55e00", SvgMarkShape::kDisc},     {"#0072b2", SvgMarkShape::kSquare},
      {"#009e73", SvgMarkShape::kDiamond},  {"#cc79a7", SvgMarkShape::kCross},
      {"#56b4e9", SvgMarkShape::kTriangle}, {"#b09a00", SvgMarkShape::kSquare},
      {"#888888", SvgMarkShape::kDisc},     {"#000000", SvgMarkShape::kCross},
      {"#e69f00", SvgMarkShape::kTriangle}, {"#000000", SvgMarkShape::kDiamond}};
  const auto& [colour, mark] = kStyles[place % std::size(kStyles)];
  return {colour, 4, mark, false};
}

std::string XyChartsSvg(const std::vector<XyChart>& charts) {
  std::string bodies;
  double top_px = 0;
  for (const XyChart& chart : charts) {
    const std::string body = ChartBody(chart);
    if (body.empty()) continue;
    bodies += fmt::format("<g transform=\"translate(0 {:.0f})\">\n{}</g>\n", top_px, body);
    top_px += kHeightPx;
  }
  return bodies.empty() ? "" : SvgDocument(kWidthPx, top_px, bodies);
}

}  // namespace luxfit
