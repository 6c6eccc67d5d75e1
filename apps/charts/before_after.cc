#include "apps/charts/before_after.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace luxfit {
namespace {

XyStyle Fainter(XyStyle style) {
  style.colour = LighterTone(style.colour);
  style.radius_px *= 0.8;
  style.is_dashed = true;
  return style;
}

bool HasFinitePoint(const XySeries& series) {
  return std::any_of(series.points.begin(), series.points.end(),
                     [](const Eigen::Vector2d& point) { return point.allFinite(); });
}

// Widens the limits that are given; absent ones follow from the data.
void Widen(XyAxis& axis, const XyAxis& other) {
  if (axis.min && other.min) axis.min = std::min(*axis.min, *other.min);
  if (axis.max && other.max) axis.max = std::max(*axis.max, *other.max);
}

// Returns the series of `before` as they are drawn below those of `after`, which have their styles.
std::vector<XySeries> FaintSeries(const XyChart& before, const std::vector<XySeries>& after) {
  std::vector<XySeries> faint = before.series;
  std::size_t next_place = after.size();
  for (XySeries& series : faint) {
    series.labels.clear();
    const auto same = std::find_if(after.begin(), after.end(),
                                   [&](const XySeries& other) { return other.name == series.name; });
    if (same != after.end()) {
      series.style = Fainter(*same->style);
      if (HasFinitePoint(*same)) series.name.clear();
    } else {
      series.style = Fainter(series.style.value_or(XyStyleAt(next_place++)));
    }
  }
  return faint;
}

}  // namespace

std::string LighterTone(const std::string& colour) {
  const auto fail = [&] { throw std::invalid_argument("LighterTone: expected #rrggbb, got " + colour); };
  if (colour.size() != 7 || colour[0] != '#') fail();
  std::array<int, 3> rgb{};
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const char* const begin = colour.data() + 1 + 2 * i;
    if (std::from_chars(begin, begin + 2, rgb[i], 16).ptr != begin + 2) fail();
    rgb[i] = (rgb[i] + 255) / 2;
  }
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

XyChart WithBefore(XyChart chart, const XyChart& before, const BeforeAfterNames& names) {
  if (std::none_of(before.series.begin(), before.series.end(), HasFinitePoint)) return chart;
  for (std::size_t i = 0; i < chart.series.size(); ++i)
    chart.series[i].style = chart.series[i].style.value_or(XyStyleAt(i));
  std::vector<XySeries> faint = FaintSeries(before, chart.series);
  const bool is_joined = std::any_of(chart.series.begin(), chart.series.end(),
                                     [](const XySeries& series) { return series.is_joined; });
  const XyStyle dark{"#333333", 4, SvgMarkShape::kDisc};
  chart.keys = {{names.after, {}, {}, is_joined, dark}, {names.before, {}, {}, is_joined, Fainter(dark)}};
  chart.series.insert(chart.series.begin(), std::make_move_iterator(faint.begin()),
                      std::make_move_iterator(faint.end()));
  Widen(chart.x, before.x);
  Widen(chart.y, before.y);
  return chart;
}

}  // namespace luxfit
