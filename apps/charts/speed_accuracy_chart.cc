#include "apps/charts/speed_accuracy_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "forward/factors/form_factors.h"

namespace luxfit {
namespace {

constexpr double kLeastS = 1e-6, kLeastPercent = 1e-3;  // a logarithmic axis has no 0
constexpr char kAutomatic[] = "automatic";

// Steps right and down: the least error within each time.
std::vector<Eigen::Vector2d> FrontSteps(std::vector<Eigen::Vector2d> front, double end_s) {
  std::sort(front.begin(), front.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
  std::vector<Eigen::Vector2d> steps;
  steps.reserve(2 * front.size() + 1);
  for (const Eigen::Vector2d& point : front) {
    if (!steps.empty()) steps.emplace_back(point.x(), steps.back().y());
    steps.push_back(point);
  }
  if (!steps.empty()) steps.emplace_back(end_s, steps.back().y());
  return steps;
}

std::string AutomaticName(const ChartPoint& point) {
  const std::string bounces = point.bounces ? std::to_string(*point.bounces) : "all";
  return fmt::format(
      "automatic: {}\n{:g} to {:g} m, {} rays\n{} bounces, {:.2g} s\n"
      "error {:.2g} %\nestimated error {:.2g} %",
      ToString(point.method), point.patch_size_m, point.element_size_m, point.rays, bounces, point.time_s,
      point.error_percent, point.estimated_error_percent.value_or(0));
}

// Returns the methods, the sweeps, the front and the automatic choice, on axes that hold them.
XyChart ChartOfPoints(const std::vector<ChartPoint>& points) {
  constexpr double kMargin = 1.3;
  if (points.empty()) return {};
  const auto [fastest, slowest] =
      std::minmax_element(points.begin(), points.end(),
                          [](const ChartPoint& a, const ChartPoint& b) { return a.time_s < b.time_s; });
  XyChart picture;
  picture.x = {"time for the whole prediction, s", true, std::max(fastest->time_s, kLeastS) / kMargin,
               std::max(slowest->time_s, kLeastS) * kMargin};
  picture.y = {"error of the illuminance, rms over sensors and luminaires, %", true, {}, {}};
  for (const FormFactorOps& ops : FormFactorMethods()) picture.series.push_back({ops.name, {}, {}, false});
  XySeries sweeps{"bounces, solvers", {}, {}, false, XyStyle{"#000000", 2.5, SvgMarkShape::kDisc}};
  XySeries automatic{kAutomatic, {}, {}, false, XyStyle{"#d00000", 11}};
  std::vector<Eigen::Vector2d> front;
  for (const ChartPoint& point : points) {
    const Eigen::Vector2d at(std::max(point.time_s, kLeastS), std::max(point.error_percent, kLeastPercent));
    const bool is_sweep = point.factor == "bounces" || point.factor == "solver";
    const auto method = static_cast<size_t>(&OpsOf(point.method) - FormFactorMethods().data());
    (is_sweep ? sweeps : picture.series[method]).points.push_back(at);
    if (point.on_front) front.push_back(at);
    if (point.automatic) automatic.points.push_back(at);
  }
  picture.series.push_back(std::move(sweeps));
  picture.series.push_back(
      {"Pareto front", FrontSteps(front, *picture.x.max), {}, true, XyStyle{"#333333", 0}});
  picture.series.push_back(std::move(automatic));
  return picture;
}

XySeries NoiseOfReference(const ChartReference& reference, const XyAxis& time) {
  const double sigma = std::max(reference.sigma_percent, kLeastPercent);
  return {"noise of the reference",
          {{*time.min, sigma}, {*time.max, sigma}},
          {},
          true,
          XyStyle{"#777777", 0, {}, true}};
}

// Names the automatic choice with its settings in the legend.
void NameAutomatic(std::vector<XySeries>& series, const std::vector<ChartPoint>& points) {
  const auto chosen =
      std::find_if(points.begin(), points.end(), [](const ChartPoint& point) { return point.automatic; });
  for (XySeries& one : series) {
    if (one.name == kAutomatic && chosen != points.end()) one.name = AutomaticName(*chosen);
  }
}

}  // namespace

XyChart SpeedAccuracyChart(const Chart& chart, const std::string& title,
                           const std::vector<ChartPoint>& before, const BeforeAfterNames& names) {
  if (chart.points.empty()) return {};
  XyChart picture = WithBefore(ChartOfPoints(chart.points), ChartOfPoints(before), names);
  picture.title = title;
  picture.subtitle = fmt::format(
      "each point one way to compute the same illuminance; reference: light tracer, "
      "{} paths a sensor, ± {:.2g} %",
      chart.reference.paths_per_sensor, chart.reference.sigma_percent);
  NameAutomatic(picture.series, chart.points);
  // The noise is drawn second to last, as the ring lies above all.
  picture.series.insert(picture.series.end() - 1, NoiseOfReference(chart.reference, picture.x));
  return picture;
}

}  // namespace luxfit
