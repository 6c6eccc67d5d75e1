#include "apps/report/report_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/stages/simulate/given_session.h"
#include "apps/text/formats/base64.h"
#include "apps/text/formats/json_vectors.h"
#include "forward/views/glare.h"
#include "forward/views/illuminance_plane.h"
#include "forward/views/room_sides.h"

namespace luxfit {
namespace {

using nlohmann::json;

struct ReportPlane {
  TargetArea area;
  IlluminancePlane plane;
  PlaneGrid grid;
  std::vector<GridPointKind> kinds;
  Eigen::Index first_place = 0;
  // The same rectangle with `refined` times as many points a side, for lines of equal illuminance. It has
  // total_lx alone, from fewer rays (about 0.3 % of the indirect light).
  int refined = 1;
  PlaneGrid fine_grid;
  std::vector<GridPointKind> fine_kinds;
  PlaceLight fine;
};

// Holds a wall, a ceiling, or the cylindrical illuminance over an area.
struct ReportSurface {
  std::string kind;  // wall | ceiling | cylindrical
  std::optional<double> required_lx;
  ReportPlane plane;
};

struct ReportObserver {
  TargetObserver target;
  bool is_inside = false;            // inside a solid: no glare is computed
  std::vector<GlareSource> sources;  // by luminaire
  Eigen::Index place = 0;
};

struct ReportPlaces {
  ReadingPlaces readings;  // places 0..
  std::vector<ReportPlane> planes;
  std::vector<ReportSurface> surfaces;
  std::vector<ReportObserver> observers;
  PlaceLight light;
  std::vector<Eigen::VectorXd> state_lx;  // by state of the session
  double relative_model_error = 0;
  std::vector<std::string> undetermined;  // parameters of the fit
};

// Refines the grid by an odd factor, so that the standard's points are among the fine ones. Closer than 5 cm light
// hardly differs: small areas, of which there are many, then cost little.
void Refine(const FittedRoom& fitted, ReportPlane& plane) {
  constexpr Eigen::Index kMaxFinePoints = 800;
  constexpr double kFinestM = 0.05;
  const double step_m = std::min(plane.plane.edge_u.norm() / plane.grid.count_u,
                                 plane.plane.edge_v.norm() / plane.grid.count_v);
  for (Eigen::Index side = 3; side * side * plane.grid.points.cols() <= kMaxFinePoints; side += 2) {
    if (step_m < kFinestM * static_cast<double>(side)) break;
    plane.refined = static_cast<int>(side);
  }
  plane.fine_grid =
      GridOf(plane.plane, plane.refined * plane.grid.count_u, plane.refined * plane.grid.count_v);
  plane.fine_kinds = ClassifyPoints(fitted.room, plane.fine_grid, plane.area.polygon_m, !plane.area.plane);
}

// Lights the fine points of all planes in one call, so that the luminaires' shadows are searched only once.
void LightFinePoints(const FittedRoom& fitted, std::vector<ReportPlane>& planes) {
  constexpr int kRays = 2048;
  std::vector<Sensor> sensors;
  for (const ReportPlane& plane : planes) {
    sensors.reserve(sensors.size() + static_cast<size_t>(plane.fine_grid.points.cols()));
    for (const auto& point : plane.fine_grid.points.colwise())
      sensors.push_back({point, plane.fine_grid.normal, {}});
  }
  if (sensors.empty()) return;
  const PlaceLight light = fitted.light->LightAt(sensors, {}, kRays);
  Eigen::Index first = 0;
  for (ReportPlane& plane : planes) {
    plane.fine.total_lx = light.total_lx.middleRows(first, plane.fine_grid.points.cols());
    if (light.body_response.size() > 0)
      plane.fine.body_response = light.body_response.middleRows(first, plane.fine_grid.points.cols());
    first += plane.fine_grid.points.cols();
  }
}

std::vector<ReportPlane> PlanesOf(const FittedRoom& fitted, const std::vector<TargetArea>& areas) {
  std::vector<ReportPlane> planes;
  for (const TargetArea& area : areas) {
    ReportPlane plane;
    plane.area = area;
    if (area.plane) {
      plane.plane = *area.plane;
    } else {
      const std::optional<IlluminancePlane> floor =
          FloorPlane(fitted.room.scene, area.height_m, area.margin_m);
      if (!area.polygon_m.empty()) {
        const auto whole = FloorPlane(fitted.room.scene, area.height_m, 0);
        plane.plane = PlaneOverOutline(area.polygon_m, whole ? whole->origin.z() : area.height_m);
      } else if (floor) {
        plane.plane = *floor;
      } else {
        continue;
      }
    }
    plane.plane.spacing_m = area.spacing_m;
    plane.grid = GridOf(plane.plane);
    plane.kinds = ClassifyPoints(fitted.room, plane.grid, area.polygon_m, !area.plane);
    Refine(fitted, plane);
    planes.push_back(std::move(plane));
  }
  return planes;
}

std::vector<ReportObserver> ObserversOf(const FittedRoom& fitted,
                                        const std::vector<TargetObserver>& targets) {
  std::vector<ReportObserver> observers;
  for (const TargetObserver& target : targets) {
    ReportObserver observer{target, false, {}, 0};
    PlaneGrid eye;
    eye.normal = target.looking;
    eye.points = target.eye_m;
    observer.is_inside = ClassifyPoints(fitted.room, eye, {}, false).front() == GridPointKind::kInSolid;
    for (const Luminaire& luminaire : fitted.luminaires)
      observer.sources.push_back(GlareOf(fitted.room.rays, luminaire, {target.eye_m, target.looking}));
    observers.push_back(std::move(observer));
  }
  return observers;
}

std::string SideName(const RoomSide& side, const PlaneGrid& grid) {
  const Eigen::Vector3d on_surface = side.plane.origin - RoomSide::kOffSurfaceM * grid.normal;
  if (side.is_ceiling) return fmt::format("Ceiling z = {:.2f} m", on_surface.z());
  for (const int axis : {0, 1}) {
    if (std::abs(grid.normal[axis]) > 0.999)
      return fmt::format("Wall {} = {:.2f} m", "xy"[axis], on_surface[axis] + 0.0);
  }
  return fmt::format("Wall facing {:.0f} degrees from +x",
                     180 / M_PI * std::atan2(grid.normal.y(), grid.normal.x()));
}

// Returns the largest demand of the areas, all of which are in the room.
std::optional<double> LargestDemand(const std::vector<TargetArea>& areas,
                                    std::optional<double> TargetArea::*demand) {
  std::optional<double> largest;
  for (const TargetArea& area : areas) {
    if (area.*demand) largest = std::max(largest.value_or(0), *(area.*demand));
  }
  return largest;
}

std::vector<ReportSurface> BoundingSurfaces(const FittedRoom& fitted, const std::vector<TargetArea>& areas) {
  constexpr double kCylinderHeightM = 1.2;  // of persons who sit
  std::vector<ReportSurface> surfaces;
  for (const RoomSide& side : SidesOf(fitted.room)) {
    ReportSurface surface;
    surface.kind = side.is_ceiling ? "ceiling" : "wall";
    surface.required_lx =
        LargestDemand(areas, side.is_ceiling ? &TargetArea::ceiling_lx : &TargetArea::wall_lx);
    surface.plane.plane = side.plane;
    surface.plane.grid = GridOf(side.plane);
    surface.plane.kinds = ClassifySidePoints(fitted.room, side, surface.plane.grid);
    surface.plane.area.id = SideName(side, surface.plane.grid);
    surfaces.push_back(std::move(surface));
  }
  for (TargetArea area : areas) {
    if (area.plane) continue;
    area.height_m = kCylinderHeightM;
    for (ReportPlane& plane : PlanesOf(fitted, {area}))
      surfaces.push_back({"cylindrical", area.cylindrical_lx, std::move(plane)});
  }
  return surfaces;
}

// Returns the sensor at the eye: a meter that faces where the observer looks.
Sensor EyeOf(const TargetObserver& target) { return {target.eye_m, target.looking, {}}; }

void AddSensors(ReportPlane& plane, const SensorResponse& response, std::vector<Sensor>& sensors) {
  plane.first_place = static_cast<Eigen::Index>(sensors.size());
  sensors.reserve(sensors.size() + static_cast<size_t>(plane.grid.points.cols()));
  for (const auto& point : plane.grid.points.colwise())
    sensors.push_back({point, plane.grid.normal, response});
}

ReportPlaces PlacesOf(const FittedRoom& fitted, const FitUncertainty& fit, const ReportTargets& targets) {
  ReportPlaces places;
  places.readings = PlacesOfReadings(fitted.session);
  std::vector<Sensor> sensors = places.readings.sensors;
  if (!fitted.room.scene.facets.empty()) {
    places.planes = PlanesOf(fitted, targets.areas);
    LightFinePoints(fitted, places.planes);
    places.surfaces = BoundingSurfaces(fitted, targets.areas);
    places.observers = ObserversOf(fitted, targets.observers);
  }
  for (ReportPlane& plane : places.planes) AddSensors(plane, {}, sensors);
  for (ReportSurface& surface : places.surfaces) {
    SensorResponse response;
    if (surface.kind == "cylindrical") response.kind = ResponseKind::kCylindrical;
    AddSensors(surface.plane, response, sensors);
  }
  for (ReportObserver& observer : places.observers) {
    observer.place = static_cast<Eigen::Index>(sensors.size());
    sensors.push_back(EyeOf(observer.target));
  }
  places.relative_model_error = fit.relative_model_sigma;
  places.undetermined = NamesOf(fit.Undetermined());
  places.light = fitted.light->LightAt(sensors, fit.covariance.size() > 0
                                                    ? ParameterCovariance{fit.parameters, fit.covariance}
                                                    : ParameterCovariance{});
  for (const SessionState& state : fitted.session.states)
    places.state_lx.push_back(places.light.Under(DimmingOf(fitted, state.id)));
  // Sigmas would be too small where a parameter is not known at all.
  if (!places.undetermined.empty()) places.light.factor.resize(0, 0);
  return places;
}

// Returns the factor of the covariance for places from `first` on, under dimming.
Eigen::MatrixXd FactorUnder(const PlaceLight& light, const Eigen::VectorXd& dimming, Eigen::Index first,
                            Eigen::Index count) {
  if (light.factor.size() == 0) return {};
  const Eigen::Index lamps = dimming.size();
  Eigen::MatrixXd factor(count, light.factor.cols());
  for (Eigen::Index i = 0; i < count; ++i)
    factor.row(i) = dimming.transpose() * light.factor.middleRows((first + i) * lamps, lamps);
  return factor;
}

PlaneStatistics StatisticsUnder(const ReportPlaces& places, const ReportPlane& plane,
                                const Eigen::VectorXd& light_lx, const Eigen::VectorXd& dimming) {
  const Eigen::Index count = plane.grid.points.cols();
  std::vector<bool> counts;
  counts.reserve(plane.kinds.size());
  for (const GridPointKind kind : plane.kinds) counts.push_back(kind == GridPointKind::kCounts);
  return StatisticsOf(light_lx.segment(plane.first_place, count), counts,
                      FactorUnder(places.light, dimming, plane.first_place, count),
                      places.relative_model_error);
}

// Returns the glare rating. It is NaN where it is undefined: no background light, or a luminaire that is on
// without a known luminous area.
double GlareUnder(const ReportPlaces& places, const ReportObserver& observer, const Eigen::VectorXd& light_lx,
                  const Eigen::VectorXd& dimming) {
  constexpr double kNotDefined = std::numeric_limits<double>::quiet_NaN();
  if (observer.is_inside) return kNotDefined;
  double sum = 0;
  for (Eigen::Index k = 0; k < dimming.size(); ++k) {
    const GlareSource& source = observer.sources[static_cast<size_t>(k)];
    if (dimming[k] > 0 && !source.is_defined) return kNotDefined;
    sum += dimming[k] * dimming[k] * source.sum;
  }
  const double indirect_lx =
      light_lx[observer.place] - places.light.direct_lx.row(observer.place).dot(dimming);
  return indirect_lx > 0 ? UnifiedGlareRating(sum, indirect_lx / M_PI) : kNotDefined;
}

// Encodes the light of `count` places from `first` on; the rows of a place are its luminaires.
json LightJson(const PlaceLight& light, Eigen::Index first, Eigen::Index count) {
  const Eigen::Index lamps = light.total_lx.cols();
  json block = {{"total", Base64Floats(light.total_lx.middleRows(first, count))}};
  if (light.body_response.size() > 0)
    block["body"] = Base64Floats(light.body_response.middleRows(first, count));
  block["modes"] = light.factor.cols();
  if (light.factor.size() > 0)
    block["factor"] = Base64Floats(light.factor.middleRows(first * lamps, count * lamps));
  return block;
}

json OptionalJson(const std::optional<double>& value) { return value ? json(*value) : json(); }

json StatisticsJson(const PlaneStatistics& s, bool has_sigma) {
  json entry = {{"points", s.points},         {"average_lx", s.average_lx}, {"least_lx", s.least_lx},
                {"largest_lx", s.largest_lx}, {"uniformity", s.uniformity}, {"diversity", s.diversity}};
  entry["average_sigma_lx"] = has_sigma ? json(s.average_sigma_lx) : json();
  entry["least_sigma_lx"] = has_sigma ? json(s.least_sigma_lx) : json();
  entry["uniformity_sigma"] = has_sigma ? json(s.uniformity_sigma) : json();
  return entry;
}

json KindsJson(const std::vector<GridPointKind>& kinds) {
  json list = json::array();
  for (const GridPointKind kind : kinds) list.push_back(static_cast<int>(kind));
  return list;
}

json PlaneJson(const FittedRoom& fitted, const ReportPlaces& places, const ReportPlane& plane) {
  json entry = {{"id", plane.area.id},
                {"task", plane.area.task},
                {"average_lx", OptionalJson(plane.area.average_lx)},
                {"uniformity", OptionalJson(plane.area.uniformity)},
                {"ugr", OptionalJson(plane.area.ugr)},
                {"origin_m", VectorJson(plane.plane.origin)},
                {"edge_u_m", VectorJson(plane.plane.edge_u)},
                {"edge_v_m", VectorJson(plane.plane.edge_v)},
                {"normal", VectorJson(plane.grid.normal)},
                {"count_u", plane.grid.count_u},
                {"count_v", plane.grid.count_v},
                {"light", LightJson(places.light, plane.first_place, plane.grid.points.cols())},
                {"statistics", json::array()}};
  entry["kinds"] = KindsJson(plane.kinds);
  for (size_t s = 0; s < places.state_lx.size(); ++s)
    entry["statistics"].push_back(StatisticsJson(
        StatisticsUnder(places, plane, places.state_lx[s], DimmingOf(fitted, fitted.session.states[s].id)),
        places.light.factor.size() > 0));
  return entry;
}

json ObserverJson(const FittedRoom& fitted, const ReportPlaces& places, const ReportObserver& observer) {
  json entry = {{"id", observer.target.id},
                {"eye_m", VectorJson(observer.target.eye_m)},
                {"looking", VectorJson(observer.target.looking)},
                {"ugr", OptionalJson(observer.target.ugr)},
                {"is_inside", observer.is_inside},
                {"sources", json::array()},
                {"rating", json::array()}};
  const Eigen::RowVectorXd indirect =
      places.light.total_lx.row(observer.place) - places.light.direct_lx.row(observer.place);
  entry["indirect_lx"] = VectorJson(indirect.transpose());
  for (const GlareSource& source : observer.sources)
    entry["sources"].push_back({{"is_defined", source.is_defined},
                                {"sum", source.sum},
                                {"solid_angle_sr", source.solid_angle_sr},
                                {"luminance_cd_m2", source.luminance_cd_m2},
                                {"least_index", source.least_index}});
  if (places.light.body_response.size() > 0)
    entry["body"] = VectorJson(places.light.body_response.row(observer.place).transpose());
  for (size_t s = 0; s < places.state_lx.size(); ++s)
    entry["rating"].push_back(NumberOrNull(
        GlareUnder(places, observer, places.state_lx[s], DimmingOf(fitted, fitted.session.states[s].id))));
  return entry;
}

}  // namespace

json ReportPlacesJson(const FittedRoom& fitted, const FitUncertainty& fit, const ReportTargets& targets) {
  const ReportPlaces places = PlacesOf(fitted, fit, targets);
  json page = {{"planes", json::array()}, {"observers", json::array()}};
  const Eigen::Index count = static_cast<Eigen::Index>(places.readings.sensors.size());
  page["points"] = json::array();
  for (const Sensor& sensor : places.readings.sensors)
    page["points"].push_back(
        {{"position_m", VectorJson(sensor.position)}, {"normal", VectorJson(sensor.normal)}});
  page["point_of_reading"] = places.readings.sensor_of_reading;
  page["point_light"] = LightJson(places.light, 0, count);
  if (places.light.body_incident.size() > 0)
    page["body_incident_lx"] = MatrixJson(places.light.body_incident);
  page["relative_model_error"] = places.relative_model_error;
  page["undetermined"] = places.undetermined;
  page["left_out"] = NamesOf(places.light.left_out);
  for (const ReportPlane& plane : places.planes) {
    json entry = PlaneJson(fitted, places, plane);
    entry["fine"] = {{"refined", plane.refined},
                     {"kinds", KindsJson(plane.fine_kinds)},
                     {"light", LightJson(plane.fine, 0, plane.fine.total_lx.rows())}};
    page["planes"].push_back(entry);
  }
  page["surfaces"] = json::array();
  for (const ReportSurface& surface : places.surfaces) {
    json entry = PlaneJson(fitted, places, surface.plane);
    entry["kind"] = surface.kind;
    entry["required_lx"] = OptionalJson(surface.required_lx);
    page["surfaces"].push_back(entry);
  }
  for (const ReportObserver& observer : places.observers)
    page["observers"].push_back(ObserverJson(fitted, places, observer));
  return page;
}

}  // namespace luxfit
