#include "apps/charts/chart_axis.h"

#include <algorithm>
#include <cmath>

namespace luxfit {
namespace {

std::vector<double> LogTicks(double min, double max) {
  std::vector<double> ticks;
  const int first = static_cast<int>(std::floor(std::log10(min))),
            last = static_cast<int>(std::ceil(std::log10(max)));
  const std::vector<int> steps = std::log10(max / min) > 4 ? std::vector<int>{1} : std::vector<int>{1, 2, 5};
  for (int decade = first; decade <= last; ++decade) {
    for (const int step : steps) {
      const double value = step * std::pow(10.0, decade);
      if (value >= min && value <= max) ticks.push_back(value);
    }
  }
  return ticks;
}

std::vector<double> LinearTicks(double min, double max) {
  constexpr double kAbout = 6;
  const double rough = (max - min) / kAbout, decade = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = decade * (rough < 1.5 * decade   ? 1
                                : rough < 3.5 * decade ? 2
                                : rough < 7.5 * decade ? 5
                                                       : 10);
  std::vector<double> ticks;
  const auto first = static_cast<int>(std::ceil(min / step - 1e-9)),
             last = static_cast<int>(std::floor(max / step + 1e-9));
  for (int i = first; i <= last; ++i) ticks.push_back(step * i);
  return ticks;
}

}  // namespace

double ChartAxis::operator()(double value) const {
  const double inside = std::clamp(value, min, max);
  const double share = is_log ? std::log(inside / min) / std::log(max / min) : (inside - min) / (max - min);
  return from_px + share * (to_px - from_px);
}

std::vector<double> ChartAxis::Ticks() const {
  std::vector<double> ticks = is_log ? LogTicks(min, max) : std::vector<double>();
  if (ticks.size() < 3) ticks = LinearTicks(min, max);
  return ticks;
}

}  // namespace luxfit
