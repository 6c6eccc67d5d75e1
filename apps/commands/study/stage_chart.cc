#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "apps/charts/chart_points.h"
#include "apps/charts/speed_accuracy_chart.h"
#include "apps/commands/study/internal/earlier_chart.h"
#include "apps/commands/study/internal/forward_chart_table.h"
#include "apps/stages/simulate/accuracy_choices.h"
#include "apps/stages/simulate/given_session.h"
#include "apps/stages/stages.h"
#include "apps/text/input_error.h"
#include "forward/views/illuminance_plane.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr double kWorkPlaneM = 0.8;  // slightly above EN 12464-1's usual height of a task
constexpr int kPlaneSide = 8;        // points along the longer side

// Tells whether most of what a point sees above it is the inside of the room.
bool IsInFreeAir(const RayScene& rays, const Sensor& sensor) {
  const SensorRays sample = SampleResponse(sensor, 64);
  Eigen::Index front = 0;
  for (Eigen::Index k = 0; k < sample.directions.cols(); ++k) {
    const RayHit hit = rays.Trace(sensor.position, sample.directions.col(k));
    front += hit.facet >= 0 && hit.front ? 1 : 0;
  }
  return 2 * front > sample.directions.cols();
}

// Serves sessions without readings.
std::vector<Sensor> WorkPlane(const Session& session, const Scene& scene) {
  const Eigen::AlignedBox3d box = scene.Bounds();
  std::vector<Sensor> sensors;
  if (!box.isEmpty() && box.sizes().z() > kWorkPlaneM) {
    IlluminancePlane plane;
    plane.origin = box.min() + kWorkPlaneM * Eigen::Vector3d::UnitZ();
    plane.edge_u = box.sizes().x() * Eigen::Vector3d::UnitX();
    plane.edge_v = box.sizes().y() * Eigen::Vector3d::UnitY();
    plane.spacing_m = std::max(box.sizes().x(), box.sizes().y()) / kPlaneSide;
    const PlaneGrid grid = GridOf(plane);
    const RayScene rays(scene);
    for (Eigen::Index k = 0; k < grid.points.cols(); ++k) {
      const Sensor sensor{grid.points.col(k), grid.normal, {}};
      if (IsInFreeAir(rays, sensor)) sensors.push_back(sensor);
    }
  }
  if (sensors.empty())
    throw InputError({session.path, 0}, "luxmeter.readings",
                     "expected places to predict, got none, and the mesh holds no work plane at 0.8 m; add "
                     "[luxmeter] with a table whose illuminance_lx may be empty");
  return sensors;
}

json PointJson(const ChartPoint& p) {
  json point = {{"factor", p.factor},
                {"method", ToString(p.method)},
                {"rays", p.rays},
                {"patch_size_m", p.patch_size_m},
                {"element_size_m", p.element_size_m},
                {"adaptive", p.adaptive},
                {"bounces", BouncesOf(p)},
                {"solver", ToString(p.solver)},
                {"patches", p.patches},
                {"time_s", p.time_s},
                {"error_percent", p.error_percent},
                {"on_front", p.on_front},
                {"automatic", p.automatic}};
  if (p.estimated_error_percent) point["estimated_error_percent"] = *p.estimated_error_percent;
  return point;
}

json Artifact(const Session& session, const ChartOptions& options, const Chart& chart, size_t sensors,
              const RunContext& context) {
  json artifact = ProvenanceJson("luxfit-chart-1", context.provenance);
  artifact["session"] = session.name;
  artifact["machine"] = {{"threads", std::thread::hardware_concurrency()},
                         {"threads_asked", options.threads}};
  artifact["budget_s"] = options.budget_s;
  artifact["error_percent_asked"] = options.error_percent;
  artifact["sensors"] = sensors;
  artifact["reference"] = {{"method", "light tracer"},
                           {"paths_per_sensor", chart.reference.paths_per_sensor},
                           {"sigma_percent", chart.reference.sigma_percent}};
  artifact["automatic"] = PointJson(chart.points.front());
  artifact["automatic"]["choosing_s"] = chart.choosing_s;
  artifact["automatic"]["tried"] = TriedJson(chart.choice);
  artifact["front"] = json::array();
  for (const ChartPoint& point : chart.points) {
    if (point.on_front) artifact["front"].push_back(PointJson(point));
  }
  artifact["points"] = chart.points.size();
  artifact["skipped"] = json::array();
  for (const SkippedPoint& skipped : chart.skipped) {
    artifact["skipped"].push_back({{"factor", skipped.point.factor},
                                   {"method", ToString(skipped.point.method)},
                                   {"rays", skipped.point.rays},
                                   {"patch_size_m", skipped.point.patch_size_m},
                                   {"expected_s", skipped.expected_s}});
  }
  artifact["choices"] = ChoicesJson(context);
  artifact["warnings"] = WarningsJson(context);
  artifact["timing_s"] = context.timing_s;
  return artifact;
}

// Reads the given session; where a value is missing, the message refers to the result of a fit.
GivenScene ReadGiven(const Session& session, RunContext& context) {
  try {
    return ReadGivenScene(session, "chart", context);
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(std::string(e.what()) +
                             "; or give the result of an earlier fit: --result OUT/result.json");
  }
}

// Returns the points of the earlier chart; none where none was named.
std::vector<ChartPoint> PointsBefore(const Session& session, const ChartOptions& options,
                                     RunContext& context) {
  if (options.before.path.empty()) return {};
  const CsvTable table = ReadEarlierChart(options.before.path, {ChartKind::kForward, session.name, ""});
  context.provenance.inputs.push_back(table.path);
  return ForwardPointsOf(table);
}

}  // namespace

json ChartSession(const Session& session, const ChartOptions& options, RunContext& context) {
  const std::vector<ChartPoint> before = PointsBefore(session, options, context);
  GivenScene given = ReadGiven(session, context);
  if (given.lit.sensors.empty()) given.lit.sensors = WorkPlane(session, given.lit.scene);
  Chart chart;
  {
    const StageTimer timer(context, "chart",
                           fmt::format("{} luminaires, {} sensors, up to {:g} s", given.lit.luminaires.size(),
                                       given.lit.sensors.size(), options.budget_s));
    chart = MeasureChart(given.lit, options.error_percent, options.budget_s);
  }
  RecordAccuracy(chart.choice, chart.points.front().patches, options.error_percent, context);
  json artifact = Artifact(session, options, chart, given.lit.sensors.size(), context);
  WriteText(context.out + "/chart.csv", ForwardChartCsv(chart.points));
  WriteText(context.out + "/chart.svg",
            XyChartsSvg({SpeedAccuracyChart(chart, session.name + ": speed against accuracy", before,
                                            options.before.names)}));
  WriteJson(context.out + "/stages/chart.json", artifact);
  return artifact;
}

std::string ChartTable(const json& artifact) {
  std::string text =
      fmt::format("session {}: {} points, {} skipped; reference ± {:.2g} %\n\non the front:\n",
                  artifact["session"].get<std::string>(), artifact["points"].get<int>(),
                  artifact["skipped"].size(), artifact["reference"]["sigma_percent"].get<double>());
  const auto row = [](const json& p) {
    return fmt::format("{:<18} {:>6} {:>7g} {:>9g} {:>7} {:<19} {:>9.4f} {:>9.3f}\n",
                       p["method"].get<std::string>(), p["rays"].get<int>(), p["patch_size_m"].get<double>(),
                       p["element_size_m"].get<double>(), p["bounces"].get<std::string>(),
                       p["solver"].get<std::string>(), p["time_s"].get<double>(),
                       p["error_percent"].get<double>());
  };
  text += "method               rays patch m element m bounces solver                 time s   error %\n";
  for (const json& p : artifact["front"]) text += row(p);
  text += "\nautomatic choice:\n" + row(artifact["automatic"]);
  text += fmt::format("estimated error {:.2g} %; choosing it took {:.3g} s with its result\n",
                      artifact["automatic"]["estimated_error_percent"].get<double>(),
                      artifact["automatic"]["choosing_s"].get<double>());
  return text + WarningText(artifact);
}

}  // namespace luxfit
