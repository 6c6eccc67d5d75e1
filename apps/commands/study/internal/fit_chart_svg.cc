#include "apps/commands/study/internal/fit_chart_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "apps/text/suggest.h"

namespace luxfit {
namespace {

std::vector<std::string> FactorsOf(const std::vector<FitPoint>& points) {
  std::vector<std::string> factors;
  for (const FitPoint& p : points) {
    if (std::count(factors.begin(), factors.end(), p.factor) == 0) factors.push_back(p.factor);
  }
  return factors;
}

XyChart ErrorChart(const std::vector<FitPoint>& points, const std::string& title, const std::string& unit,
                   double FitPoint::*error) {
  XyChart chart;
  chart.title = title;
  chart.subtitle = "one thing varied at a time; labels: its value; the best is at the lower left";
  chart.x = {"processor time of form factors and fit, s", true, {}, {}};
  chart.y = {unit, true, {}, {}};
  for (const std::string& factor : FactorsOf(points)) {
    XySeries series{factor, {}, {}, true};
    for (const FitPoint& p : points) {
      if (p.factor != factor) continue;
      series.points.push_back({p.time_s, p.*error});
      series.labels.push_back(fmt::format("{:g}", p.value));
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

struct Cost {
  std::string name, factor;
  int FitPoint::*size;
};
const std::vector<Cost>& Costs() {
  static const std::vector<Cost> costs{{"patches", "patch_size_m", &FitPoint::patches},
                                       {"photos", "views", &FitPoint::photos},
                                       {"luminaires", "luminaires", &FitPoint::luminaires}};
  return costs;
}

// Returns (size, time) of the fits that stand.
std::vector<Eigen::Vector2d> SizesOf(const std::vector<FitPoint>& points, const Cost& cost) {
  std::vector<Eigen::Vector2d> sizes;
  for (const FitPoint& p : points) {
    if (p.factor == cost.factor && p.is_usable) sizes.emplace_back(p.*cost.size, p.time_s);
  }
  return sizes;
}

// Returns the slope of ln time over ln size; NaN where the sizes are alike.
double Slope(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points)
    mean += p.array().log().matrix() / static_cast<double>(points.size());
  double xx = 0, xy = 0;
  for (const Eigen::Vector2d& p : points) {
    const Eigen::Vector2d d = p.array().log().matrix() - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
  }
  return xx > 1e-12 ? xy / xx : NAN;
}

// Returns the largest size with its time.
Eigen::Vector2d LargestOf(const std::vector<Eigen::Vector2d>& sizes) {
  return *std::max_element(sizes.begin(), sizes.end(),
                           [](const auto& a, const auto& b) { return a.x() < b.x(); });
}

// Sizes and times are relative to the largest of `units`, so that two charts in its units compare.
XyChart CostChart(const std::vector<FitPoint>& points, const std::vector<FitPoint>& units) {
  XyChart chart;
  chart.title = "Cost of the fit";
  chart.x = {"size, of the largest", true, {}, {}};
  chart.y = {"time, of the largest's", true, {}, {}};
  for (const Cost& cost : Costs()) {
    const std::vector<Eigen::Vector2d> sizes = SizesOf(points, cost);
    if (sizes.size() < 2) continue;
    const std::vector<Eigen::Vector2d> unit_sizes = SizesOf(units, cost);
    const Eigen::Vector2d unit = LargestOf(unit_sizes.empty() ? sizes : unit_sizes);
    XySeries series{cost.name, {}, {}, true};
    for (const Eigen::Vector2d& p : sizes) series.points.push_back(p.cwiseQuotient(unit));
    chart.series.push_back(std::move(series));
  }
  return chart;
}

// Adds to the names in the legend the slopes, and those of the earlier chart.
void NameSlopes(std::vector<XySeries>& series, const std::vector<FitPoint>& points,
                const std::vector<FitPoint>& before, const std::string& before_name) {
  const std::map<std::string, double> slopes = FitSlopes(points), earlier = FitSlopes(before);
  for (XySeries& one : series) {
    const auto now = slopes.find(one.name), then = earlier.find(one.name);
    if (now != slopes.end()) one.name += fmt::format(": slope {:.2f}", now->second);
    if (then != earlier.end()) one.name += fmt::format("\n{}: {:.2f}", before_name, then->second);
  }
}

}  // namespace

std::map<std::string, double> FitSlopes(const std::vector<FitPoint>& points) {
  std::map<std::string, double> slopes;
  for (const Cost& cost : Costs()) {
    const std::vector<Eigen::Vector2d> sizes = SizesOf(points, cost);
    if (sizes.size() >= 2) slopes[cost.name] = Slope(sizes);
  }
  return slopes;
}

std::vector<FitPicture> FitPictures(const std::vector<FitPoint>& points, const std::string& session,
                                    const std::vector<FitPoint>& before, const BeforeAfterNames& names) {
  struct Error {
    const char *file, *title, *unit;
    double FitPoint::*value;
  };
  constexpr Error kErrors[] = {
      {"fit_position.svg", "luminaires' places against time", "median error of position, mm",
       &FitPoint::position_mm},
      {"fit_flux.svg", "luminaires' fluxes against time", "median error of flux, %", &FitPoint::flux_percent},
      {"fit_lux.svg", "readings against time", "mean error, % of the mean reading", &FitPoint::lux_percent}};
  std::vector<FitPicture> pictures;
  pictures.reserve(std::size(kErrors) + 1);
  for (const Error& e : kErrors) {
    const auto chart = [&](const std::vector<FitPoint>& of) {
      return ErrorChart(of, fmt::format("{}: {}", session, e.title), e.unit, e.value);
    };
    pictures.push_back({e.file, WithBefore(chart(points), chart(before), names)});
  }
  XyChart cost = WithBefore(CostChart(points, points), CostChart(before, points), names);
  cost.subtitle = fmt::format("processor time over size, each relative to {}; linear would have slope 1",
                              before.empty() ? "its largest" : "the largest of " + Quoted(names.after));
  NameSlopes(cost.series, points, before, names.before);
  pictures.push_back({"fit_cost.svg", std::move(cost)});
  return pictures;
}

}  // namespace luxfit
