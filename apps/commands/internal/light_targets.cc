#include "apps/commands/internal/light_targets.h"

#include <fmt/format.h>

#include <optional>

#include "apps/text/suggest.h"
#include "forward/views/illuminance_plane.h"

namespace luxfit {
namespace {

IlluminancePlane PlaneOf(const FittedRoom& fitted, const TargetArea& area) {
  std::optional<IlluminancePlane> plane = area.plane;
  if (!plane && !area.polygon_m.empty()) plane = PlaneOverOutline(area.polygon_m, area.height_m);
  if (!plane) plane = FloorPlane(fitted.room.scene, area.height_m, area.margin_m);
  if (!plane)
    throw std::runtime_error("targets: area " + Quoted(area.id) +
                             ": expected a floor under it, found none; give origin_m with its edges");
  plane->spacing_m = area.spacing_m;
  return *plane;
}

// Returns the columns of light by which levels are planned: the bodies of all luminaires hang there.
Eigen::MatrixXd LightWithAllOn(const FittedRoom& fitted, const std::vector<Sensor>& sensors) {
  const auto count = static_cast<Eigen::Index>(fitted.luminaires.size());
  return fitted.light->LightAt(sensors).While(Eigen::VectorXd::Ones(count));
}

// Returns the light at the points of an area that count, points x luminaires.
Eigen::MatrixXd LightOver(const FittedRoom& fitted, const TargetArea& area) {
  const PlaneGrid grid = GridOf(PlaneOf(fitted, area));
  const std::vector<GridPointKind> kinds =
      ClassifyPoints(fitted.room, grid, area.polygon_m, !area.plane.has_value());
  std::vector<Sensor> sensors;
  for (Eigen::Index i = 0; i < grid.points.cols(); ++i) {
    if (kinds[static_cast<size_t>(i)] == GridPointKind::kCounts)
      sensors.push_back({grid.points.col(i), grid.normal});
  }
  if (sensors.empty())
    throw std::runtime_error("targets: area " + Quoted(area.id) +
                             ": expected points in free air over the floor, found none; move it");
  return LightWithAllOn(fitted, sensors);
}

}  // namespace

RoomTargets TargetsOf(const FittedRoom& fitted, const std::vector<DesignPoint>& points,
                      const std::vector<TargetArea>& areas) {
  RoomTargets targets;
  std::vector<Sensor> sensors;
  sensors.reserve(points.size());
  for (const DesignPoint& point : points) sensors.push_back(point.sensor);
  const Eigen::MatrixXd at_points = sensors.empty() ? Eigen::MatrixXd() : LightWithAllOn(fitted, sensors);
  for (size_t i = 0; i < points.size(); ++i) {
    targets.requirements.push_back({{fmt::format("E at {}", points[i].id),
                                     at_points.row(static_cast<Eigen::Index>(i)), points[i].illuminance_lx},
                                    "point",
                                    points[i].id});
  }
  for (const TargetArea& area : areas) {
    const Eigen::MatrixXd light = LightOver(fitted, area);
    const Eigen::RowVectorXd mean = light.colwise().mean();
    targets.areas.push_back({area.id, light});
    if (area.average_lx)
      targets.requirements.push_back({{"E_avg of " + area.id, mean, *area.average_lx}, "average", area.id});
    if (!area.uniformity) continue;
    for (Eigen::Index i = 0; i < light.rows(); ++i)
      targets.requirements.push_back(
          {{fmt::format("U0 of {}, point {}", area.id, i + 1), light.row(i) - *area.uniformity * mean, 0},
           "uniformity",
           area.id});
  }
  return targets;
}

}  // namespace luxfit
