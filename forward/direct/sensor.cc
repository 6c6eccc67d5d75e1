#include "forward/direct/sensor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/direct/internal/cell_sum.h"
#include "forward/direct/internal/expect_sensor.h"
#include "forward/direct/internal/luminous_surface.h"
#include "forward/direct/internal/sensor_rows.h"
#include "forward/direct/internal/shadowed_light.h"
#include "forward/luminaire/internal/tabulated.h"
#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

// Holds w and dw/dtheta of a table.
struct PolarWeight {
  double value = 0, d_theta = 0;
};
PolarWeight TableWeight(const SensorResponse& response, double theta) {
  if (std::isnan(theta)) return {theta, theta};
  const std::vector<double>&angles = response.angle_rad, &values = response.relative;
  const double cosine = std::max(0.0, std::cos(theta)), d_cosine = cosine > 0 ? -std::sin(theta) : 0;
  if (theta >= angles.back()) {
    if (angles.back() >= M_PI / 2 - 1e-9) return {theta == angles.back() ? values.back() : 0, 0};
    const double ratio = values.back() / std::cos(angles.back());
    return {ratio * cosine, ratio * d_cosine};
  }
  const size_t next =
      static_cast<size_t>(std::upper_bound(angles.begin(), angles.end(), theta) - angles.begin());
  const auto deviation = [&](size_t i) { return values[i] - std::max(0.0, std::cos(angles[i])); };
  const double slope = (deviation(next) - deviation(next - 1)) / (angles[next] - angles[next - 1]);
  const double value = cosine + deviation(next - 1) + slope * (theta - angles[next - 1]);
  if (value <= 0) return {};
  return {value, d_cosine + slope};
}

bool SeesHemisphere(const SensorResponse& response) {
  return response.kind == ResponseKind::kCosine || response.kind == ResponseKind::kTable;
}

// Returns points that share the unit square evenly.
std::vector<Eigen::Vector2d> Recurrence(int count) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(static_cast<size_t>(count));
  for (int k = 1; k <= count; ++k) points.push_back(PlasticPoint(k, Eigen::Vector2d::Constant(0.5)));
  return points;
}

// Returns the weight over the polar angle alone, for the sampling.
double PolarDensity(const SensorResponse& response, double theta) {
  const double sine = std::sin(theta);
  if (response.kind == ResponseKind::kTable) return 2 * TableWeight(response, theta).value * sine;
  if (response.kind == ResponseKind::kSpherical) return sine / 2;
  return 2 / M_PI * sine * sine;  // cylinders
}

}  // namespace

Eigen::Matrix3d SensorFrameOf(const Sensor& sensor) {
  Eigen::Vector3d along = sensor.response.facing - sensor.response.facing.dot(sensor.normal) * sensor.normal;
  if (sensor.response.kind != ResponseKind::kSemicylindrical || along.norm() < 1e-9)
    along = sensor.normal.unitOrthogonal();
  Eigen::Matrix3d frame;
  frame.col(0) = along.normalized();
  frame.col(1) = sensor.normal.cross(frame.col(0));
  frame.col(2) = sensor.normal;
  return frame;
}

bool operator==(const SensorResponse& a, const SensorResponse& b) {
  return a.kind == b.kind && a.angle_rad == b.angle_rad && a.relative == b.relative && a.facing == b.facing;
}

bool operator==(const Sensor& a, const Sensor& b) {
  return a.position == b.position && a.normal == b.normal && a.response == b.response;
}

SensorResponse TableResponse(std::vector<double> angle_rad, std::vector<double> relative) {
  // Not std::is_sorted: it would let NaN pass.
  const bool ascends = std::adjacent_find(angle_rad.begin(), angle_rad.end(),
                                          [](double a, double b) { return !(a < b); }) == angle_rad.end();
  if (angle_rad.size() < 2 || angle_rad.size() != relative.size() || angle_rad[0] != 0 || !ascends ||
      !(angle_rad.back() <= M_PI + 1e-9))
    throw std::invalid_argument(
        "TableResponse: expected angles that ascend from 0 to at most pi, a value each");
  if (!(relative[0] > 0) ||
      !std::all_of(relative.begin(), relative.end(), [](double x) { return x >= 0 && std::isfinite(x); }))
    throw std::invalid_argument("TableResponse: expected values >= 0, the first > 0");
  const double first = relative[0];
  for (double& x : relative) x /= first;
  return {ResponseKind::kTable, std::move(angle_rad), std::move(relative)};
}

DirectionWeight WeightOf(const Sensor& sensor, const Eigen::Vector3d& direction) {
  const double cosine = sensor.normal.dot(direction);
  const Eigen::Vector3d across = direction - cosine * sensor.normal;  // perpendicular to the axis
  const double sine = across.norm();
  DirectionWeight weight;
  switch (sensor.response.kind) {
    case ResponseKind::kCosine:
      if (cosine > 0) weight = {cosine, sensor.normal};
      break;
    case ResponseKind::kTable: {
      const PolarWeight polar = TableWeight(sensor.response, std::atan2(sine, cosine));
      weight.value = polar.value;
      if (sine > 1e-9) weight.d_direction = polar.d_theta / sine * (cosine * direction - sensor.normal);
      break;
    }
    case ResponseKind::kCylindrical:
      weight.value = sine / M_PI;
      if (sine > 1e-9) weight.d_direction = across / (M_PI * sine);
      break;
    case ResponseKind::kSemicylindrical: {
      // sin(epsilon) cos(alpha) = d . facing
      const Eigen::Vector3d facing = SensorFrameOf(sensor).col(0);
      weight.value = (sine + direction.dot(facing)) / M_PI;
      if (sine > 1e-9) weight.d_direction = (across / sine + facing) / M_PI;
      break;
    }
    case ResponseKind::kSpherical:
      weight.value = 0.25;
      break;
  }
  weight.d_direction -= weight.d_direction.dot(direction) * direction;
  return weight;
}

DirectIlluminance SensorIlluminancePerLumen(const Luminaire& luminaire, const Sensor& sensor) {
  if (sensor.response.kind == ResponseKind::kCosine)
    return DirectIlluminancePerLumen(luminaire, sensor.position, sensor.normal);
  if (HasUnevenEmission(luminaire)) {
    return SumOverCells(luminaire,
                        [&](const Luminaire& cell) { return SensorIlluminancePerLumen(cell, sensor); });
  }
  constexpr int kOrder = 8;
  DirectIlluminance sum;
  const LuminousSurface surface(luminaire);
  Luminaire point = luminaire;
  point.shape = LuminaireShape::kPoint;
  for (const SurfaceSample& sample : SampleSurface(luminaire.shape, kOrder)) {
    const Eigen::Vector2d place(sample.a, sample.b);
    point.position = surface.PointOf(place);
    const Eigen::Vector3d to_lamp = point.position - sensor.position;
    const double r = to_lamp.norm();
    if (r < 1e-6) continue;
    const Eigen::Vector3d direction = to_lamp / r;
    const DirectionWeight weight = WeightOf(sensor, direction);
    // I / r^2 is the illuminance of a receiver that faces the point. A turn of its normal changes it in
    // second order only, so that the gradient is that of I / r^2 too.
    const DirectIlluminance beam = DirectIlluminancePerLumen(point, sensor.position, direction);
    const double share = sample.weight * weight.value;
    sum.lx_per_lm += share * beam.lx_per_lm;
    sum.d_exponent += share * beam.d_exponent;
    sum.d_tilt += share * beam.d_tilt;
    sum.d_heading += share * beam.d_heading;
    surface.AddMotion(
        place, sample.weight * (weight.value * beam.d_position + beam.lx_per_lm / r * weight.d_direction),
        sum);
  }
  return sum;
}

double SensorVisibleFraction(const RayScene& rays, const Luminaire& luminaire, const Sensor& sensor,
                             int order) {
  if (sensor.response.kind == ResponseKind::kCosine)
    return VisibleShare(rays, luminaire, sensor.position, sensor.normal);
  const Eigen::Vector3d start = RayOrigin(sensor);
  const LuminousSurface surface(luminaire);
  double seen = 0, all = 0;
  for (const SurfaceSample& sample : SampleSurface(luminaire.shape, order)) {
    const Eigen::Vector3d point = surface.PointOf({sample.a, sample.b});
    const double weight = sample.weight * WeightOf(sensor, (point - sensor.position).normalized()).value;
    all += weight;
    if (weight > 0 && !rays.Occluded(start, point)) seen += weight;
  }
  return all == 0 ? 0 : seen / all;
}

SensorRays SampleInFrame(const SensorResponse& response, int ray_count) {
  if (ray_count < 1) throw std::invalid_argument("SampleResponse: expected ray_count >= 1");
  const std::vector<Eigen::Vector2d> points =
      SeesHemisphere(response) ? Isocell(ray_count) : Recurrence(ray_count);
  SensorRays rays;
  rays.directions.resize(3, static_cast<Eigen::Index>(points.size()));
  const bool cosine = response.kind == ResponseKind::kCosine;
  const Tabulated polar(0, M_PI, [&](double theta) { return cosine ? 0 : PolarDensity(response, theta); });
  const Tabulated azimuth(-M_PI, M_PI, [&](double alpha) {
    return response.kind == ResponseKind::kSemicylindrical ? 1 + std::cos(alpha) : 1;
  });
  if (!cosine) rays.total = polar.Total();
  for (Eigen::Index k = 0; k < rays.directions.cols(); ++k) {
    const Eigen::Vector2d& point = points[static_cast<size_t>(k)];
    const double theta = cosine ? std::asin(std::sqrt(point[0])) : polar.Quantile(point[0]);
    const double alpha = azimuth.Quantile(point[1]);
    rays.directions.col(k) = Eigen::Vector3d(std::sin(theta) * std::cos(alpha),
                                             std::sin(theta) * std::sin(alpha), std::cos(theta));
  }
  return rays;
}

SensorRays SampleResponse(const Sensor& sensor, int ray_count) {
  SensorRays rays = SampleInFrame(sensor.response, ray_count);
  rays.directions = SensorFrameOf(sensor) * rays.directions;
  return rays;
}

Eigen::Vector3d RayOrigin(const Sensor& sensor) {
  return SeesHemisphere(sensor.response) ? LiftedOff(sensor.position, sensor.normal) : sensor.position;
}

Eigen::VectorXf SensorFormFactors(const RayScene& rays, const Patches& patches, const Sensor& sensor,
                                  int ray_count) {
  ExpectValid(sensor);
  return SensorRowOf(rays, patches, sensor, SampleInFrame(sensor.response, ray_count));
}

}  // namespace luxfit
