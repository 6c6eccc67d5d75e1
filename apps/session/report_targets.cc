#include "apps/session/report_targets.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/text/formats/toml_reader.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

constexpr double kSeatedEyeM = 1.2;
constexpr double kWorkPlaneM = 0.75;

std::vector<std::string> TaskKeys() {
  std::vector<std::string> keys;
  keys.reserve(LightingTasks().size());
  for (const LightingTask& task : LightingTasks()) keys.push_back(task.key);
  return keys;
}

void TakeTask(const std::string& key, TargetArea& area) {
  const auto& tasks = LightingTasks();
  const auto task =
      std::find_if(tasks.begin(), tasks.end(), [&](const LightingTask& t) { return t.key == key; });
  area.task = key;
  area.average_lx = task->average_lx;
  area.uniformity = task->uniformity;
  area.ugr = task->ugr;
  area.cylindrical_lx = task->cylindrical_lx;
  area.wall_lx = task->wall_lx;
  area.ceiling_lx = task->ceiling_lx;
}

double Share(const TomlCursor& value) {
  const double share = value.NumberAbove(0, "0..1");
  if (share > 1)
    throw value.Error("expected a share in 0..1, got " + value.Shown() + "; 60 % is written 0.6");
  return share;
}

std::vector<Eigen::Vector2d> ReadPolygon(const TomlCursor& value) {
  std::vector<Eigen::Vector2d> polygon;
  double area = 0;
  for (const TomlCursor& corner : value.Elements("corners [[x, y], ...] in m")) {
    const std::vector<double> xy = corner.Numbers("a corner [x, y] in m");
    if (xy.size() != 2)
      throw corner.Error("expected a corner [x, y] in m, got " + corner.Shown() + "; write two numbers");
    polygon.emplace_back(xy[0], xy[1]);
  }
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    area += 0.5 * (a.x() * b.y() - b.x() * a.y());
  }
  if (polygon.size() < 3 || std::abs(area) < 1e-6)
    throw value.Error("expected three corners or more round an area, got " + std::to_string(polygon.size()) +
                      "; write [[x, y], [x, y], [x, y], ...]");
  return polygon;
}

IlluminancePlane ReadEdges(const TomlCursor& table) {
  IlluminancePlane plane;
  plane.origin = table.Require("origin_m", "the corner [x, y, z] of the plane").Vector("a corner [x, y, z]");
  plane.edge_u = table.Require("edge_u_m", "an edge [x, y, z] in m").Vector("an edge [x, y, z]");
  const TomlCursor edge_v = table.Require("edge_v_m", "an edge [x, y, z] in m");
  plane.edge_v = edge_v.Vector("an edge [x, y, z]");
  if (plane.edge_u.cross(plane.edge_v).norm() < 1e-6)
    throw edge_v.Error("expected two edges with an area between them, got " + edge_v.Shown() +
                       " along edge_u_m; write edges that are not parallel");
  return plane;
}

TargetArea ReadArea(const TomlCursor& table) {
  table.ExpectKeys({"id", "task", "average_lx", "uniformity", "ugr", "cylindrical_lx", "wall_lx",
                    "ceiling_lx", "height_m", "margin_m", "spacing_m", "polygon_m", "origin_m", "edge_u_m",
                    "edge_v_m"});
  TargetArea area;
  area.id = table.Require("id", "a name").Text("a name");
  if (const auto task = table.Find("task")) TakeTask(task->OneOf(TaskKeys()), area);
  if (const auto average = table.Find("average_lx")) area.average_lx = average->NumberAbove(0, "lx");
  if (const auto uniformity = table.Find("uniformity")) area.uniformity = Share(*uniformity);
  if (const auto ugr = table.Find("ugr")) area.ugr = ugr->NumberAbove(0, "UGR");
  if (const auto level = table.Find("cylindrical_lx")) area.cylindrical_lx = level->NumberAbove(0, "lx");
  if (const auto level = table.Find("wall_lx")) area.wall_lx = level->NumberAbove(0, "lx");
  if (const auto level = table.Find("ceiling_lx")) area.ceiling_lx = level->NumberAbove(0, "lx");
  if (const auto spacing = table.Find("spacing_m")) area.spacing_m = spacing->NumberAbove(0, "m");
  const auto origin = table.Find("origin_m"), polygon = table.Find("polygon_m");
  const auto height = table.Find("height_m"), margin = table.Find("margin_m");
  if (origin && (polygon || height || margin))
    throw origin->Error(
        "expected origin_m with its edges, or polygon_m, height_m and margin_m, got both; "
        "remove one");
  if (polygon && margin)
    throw margin->Error("expected it beside the whole floor only, got polygon_m too; remove it");
  if (height) area.height_m = height->NumberAtLeast(0, "m");
  if (margin) area.margin_m = margin->NumberAtLeast(0, "m");
  if (polygon) area.polygon_m = ReadPolygon(*polygon);
  if (origin || table.Find("edge_u_m") || table.Find("edge_v_m")) area.plane = ReadEdges(table);
  return area;
}

TargetObserver ReadObserver(const TomlCursor& table) {
  table.ExpectKeys({"id", "eye_m", "looking", "ugr"});
  TargetObserver observer;
  observer.id = table.Require("id", "a name").Text("a name");
  observer.eye_m = table.Require("eye_m", "a place [x, y, z] in m").Vector("a place [x, y, z] in m");
  const TomlCursor looking = table.Require("looking", "a direction [x, y, z]");
  observer.looking = looking.Direction("a direction [x, y, z]");
  if (std::abs(observer.looking.z()) > 0.99)
    throw looking.Error("expected a line of sight that is not vertical, got " + looking.Shown() +
                        "; look along the room, such as [1, 0, 0]");
  if (const auto ugr = table.Find("ugr")) observer.ugr = ugr->NumberAbove(0, "UGR");
  return observer;
}

std::string Vector3Toml(const Eigen::Vector3d& v) {
  return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", v.x(), v.y(), v.z());
}

// Returns "+x", or the angle from +x where the direction lies along no axis.
std::string DirectionName(const Eigen::Vector3d& direction) {
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(direction[axis]) > 0.999)
      return (direction[axis] > 0 ? "+" : "-") + std::string(1, "xy"[axis]);
  }
  constexpr double kDegrees = 180 / M_PI;
  return fmt::format("{:.0f} degrees from +x", kDegrees * std::atan2(direction.y(), direction.x()));
}

}  // namespace

const std::vector<LightingTask>& LightingTasks() {
  // EN 12464-1:2021, table 34, rows 34.1 to 34.7, and table 9, row 9.1: required maintained illuminance,
  // U0, UGR limit; mean cylindrical illuminance, illuminance of walls and of the ceiling.
  static const std::vector<LightingTask> tasks = {
      {"filing", "Filing, copying, etc.", 300, 0.40, 19, 100, 100, 75},
      {"writing", "Writing, typing, reading, data processing", 500, 0.60, 19, 150, 150, 100},
      {"drawing", "Technical drawing", 750, 0.70, 16, 150, 150, 100},
      {"cad", "CAD work stations", 500, 0.60, 19, 150, 150, 100},
      {"meeting", "Conference and meeting rooms", 500, 0.60, 19, 150, 150, 100},
      {"reception", "Reception desk", 300, 0.60, 22, 100, 100, 75},
      {"archive", "Archives", 200, 0.40, 25, 75, 75, 50},
      {"circulation", "Circulation areas and corridors", 100, 0.40, 28, 50, 50, 30}};
  return tasks;
}

ReportTargets ReadTargets(const std::string& path) {
  const toml::table document = ReadTomlFile(path);
  const TomlCursor root(document, {path, 1}, "");
  root.ExpectKeys({"area", "observer", "report", "maintenance_factor", "power_w"});
  ReportTargets targets;
  targets.path = std::filesystem::absolute(path).lexically_normal().string();
  const auto areas = root.Find("area"), observers = root.Find("observer");
  if (areas) {
    const std::vector<TomlCursor> tables = areas->Elements("a list of tables [[area]]");
    UniqueIds(tables);
    for (const TomlCursor& table : tables) targets.areas.push_back(ReadArea(table));
  }
  if (observers) {
    const std::vector<TomlCursor> tables = observers->Elements("a list of tables [[observer]]");
    UniqueIds(tables);
    for (const TomlCursor& table : tables) targets.observers.push_back(ReadObserver(table));
  }
  const auto report = root.Find("report");
  if (report) targets.details = ReadReportDetails(*report);
  if (const auto factor = root.Find("maintenance_factor")) targets.maintenance_factor = Share(*factor);
  if (const auto powers = root.Find("power_w")) {
    for (const auto& [id, value] : powers->Members())
      targets.powers.push_back({id, value.NumberAbove(0, "W"), value.place().line});
  }
  const bool has_more = report || targets.maintenance_factor || !targets.powers.empty();
  if (!areas && !observers && !has_more)
    throw root.Error("expected an area or an observer, got neither; add [[area]] with id = \"...\"");
  return targets;
}

ReportTargets DefaultTargets(const Scene& scene) {
  ReportTargets targets;
  const std::optional<IlluminancePlane> floor = FloorPlane(scene, 0, 0);
  if (!floor) return targets;
  TargetArea area;
  area.id = "Work plane";
  area.height_m = kWorkPlaneM;
  TakeTask("writing", area);
  targets.areas.push_back(area);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d u = floor->edge_u.normalized(), v = floor->edge_v.normalized();
  const Eigen::Vector3d centre = floor->origin + 0.5 * (floor->edge_u + floor->edge_v) + kSeatedEyeM * up;
  // Seated observers keep a small distance from the wall.
  constexpr double kOffWallM = 0.2;
  const double half_u = 0.5 * floor->edge_u.norm() - kOffWallM,
               half_v = 0.5 * floor->edge_v.norm() - kOffWallM;
  for (const auto& [direction, back_m] : {std::pair(u, half_u), std::pair(Eigen::Vector3d(-u), half_u),
                                          std::pair(v, half_v), std::pair(Eigen::Vector3d(-v), half_v)}) {
    targets.observers.push_back(
        {"looking along " + DirectionName(direction), centre - back_m * direction, direction, area.ugr});
  }
  return targets;
}

std::string TargetsToml(const ReportTargets& targets) {
  std::string text;
  if (targets.maintenance_factor)
    text += fmt::format("maintenance_factor = {:g}\n\n", *targets.maintenance_factor);
  if (!targets.powers.empty()) {
    text += "[power_w]\n";
    for (const LuminairePower& one : targets.powers)
      text += fmt::format("{} = {:g}\n", Quoted(one.id), one.power_w);
    text += "\n";
  }
  for (const TargetArea& area : targets.areas) {
    text += fmt::format("[[area]]\nid = {}\n", Quoted(area.id));
    if (area.average_lx) text += fmt::format("average_lx = {:g}\n", *area.average_lx);
    if (area.uniformity) text += fmt::format("uniformity = {:g}\n", *area.uniformity);
    if (area.ugr) text += fmt::format("ugr = {:g}\n", *area.ugr);
    if (area.cylindrical_lx) text += fmt::format("cylindrical_lx = {:g}\n", *area.cylindrical_lx);
    if (area.wall_lx) text += fmt::format("wall_lx = {:g}\n", *area.wall_lx);
    if (area.ceiling_lx) text += fmt::format("ceiling_lx = {:g}\n", *area.ceiling_lx);
    if (area.spacing_m > 0) text += fmt::format("spacing_m = {:g}\n", area.spacing_m);
    if (area.plane) {
      text += fmt::format("origin_m = {}\nedge_u_m = {}\nedge_v_m = {}\n", Vector3Toml(area.plane->origin),
                          Vector3Toml(area.plane->edge_u), Vector3Toml(area.plane->edge_v));
    } else {
      text += fmt::format("height_m = {:g}\n", area.height_m);
      if (area.margin_m >= 0) text += fmt::format("margin_m = {:g}\n", area.margin_m);
    }
    if (!area.polygon_m.empty()) {
      text += "polygon_m = [";
      for (const Eigen::Vector2d& p : area.polygon_m) text += fmt::format("[{:.4g}, {:.4g}], ", p.x(), p.y());
      text += "]\n";
    }
    text += "\n";
  }
  for (const TargetObserver& observer : targets.observers) {
    text += fmt::format("[[observer]]\nid = {}\neye_m = {}\nlooking = {}\n", Quoted(observer.id),
                        Vector3Toml(observer.eye_m), Vector3Toml(observer.looking));
    if (observer.ugr) text += fmt::format("ugr = {:g}\n", *observer.ugr);
    text += "\n";
  }
  return text;
}

}  // namespace luxfit
