#include "inverse/study/simulated_light.h"

#include <cmath>
#include <map>
#include <utility>

#include "forward/light/light_tracer.h"

namespace luxfit {
namespace {

constexpr int kPointsPerElement = 4;
constexpr double kOffSurfaceM = 1e-4;  // so that a path does not start inside its surface

}  // namespace

TracedLight TraceLight(const Room& room, const std::vector<int>& elements,
                       const std::vector<Reading>& readings, const LightState& light,
                       const SimulatedLightOptions& options) {
  std::vector<Sensor> sensors;
  sensors.reserve(elements.size() * kPointsPerElement + readings.size());
  for (const int e : elements) {
    const Element& element = room.patches.elements[static_cast<size_t>(e)];
    for (const Eigen::Vector3d& point : ProbesOf(element, room.patches.IsTriangle(element.patch)))
      sensors.push_back({point + kOffSurfaceM * element.normal, element.normal, {}});
  }
  for (const Reading& reading : readings) sensors.push_back(reading.sensor);
  LightTracerOptions tracer;
  tracer.paths_per_sensor = options.paths_per_point;
  tracer.replicates = 2;  // the fewest: their spread is not used
  const TracedIlluminance lit =
      TraceIlluminance(room.scene, room.rays, light.luminaires, light.albedo, sensors, tracer);
  const Eigen::MatrixXd at_points = lit.direct + lit.indirect;
  TracedLight traced;
  traced.elements = elements;
  const auto n = static_cast<Eigen::Index>(elements.size()),
             extra = static_cast<Eigen::Index>(readings.size());
  traced.illuminance_lx.resize(n + extra, at_points.cols());
  for (Eigen::Index e = 0; e < n; ++e) {
    traced.illuminance_lx.row(e) =
        at_points.middleRows(e * kPointsPerElement, kPointsPerElement).colwise().mean();
  }
  traced.illuminance_lx.bottomRows(extra) = at_points.bottomRows(extra);
  return traced;
}

LightData SimulateLight(const Room& room, const TracedLight& traced, const LightState& light,
                        const std::vector<Eigen::VectorXd>& dimming, std::vector<Reading> readings,
                        std::mt19937_64& rng, const SimulatedLightOptions& options) {
  std::normal_distribution<double> normal;
  std::map<std::pair<int, int>, double> facet_error;
  LightData data;
  data.dimming = dimming;
  data.observations.reserve(traced.elements.size() * dimming.size());
  for (size_t s = 0; s < dimming.size(); ++s) {
    if (dimming[s].sum() <= 0) continue;
    for (size_t i = 0; i < traced.elements.size(); ++i) {
      const Patch& lit = room.patches.PatchOf(traced.elements[i]);
      const std::pair<int, int> cluster{lit.facet, static_cast<int>(s)};
      if (facet_error.count(cluster) == 0) facet_error[cluster] = options.facet_sigma * normal(rng);
      const double lx = traced.illuminance_lx.row(static_cast<Eigen::Index>(i)).dot(dimming[s]);
      const double noise = options.observation_sigma * normal(rng);
      Observation o;
      o.element = traced.elements[i];
      o.state = static_cast<int>(s);
      o.pixels = 100;
      o.relative_luminance = light.camera_scale * light.albedo[lit.material] * lx / M_PI *
                             (1 + facet_error.at(cluster)) * (1 + noise);
      if (!(o.relative_luminance > 0)) continue;
      o.variance = std::pow(options.observation_sigma * o.relative_luminance, 2);
      o.relative_rgb.setConstant(o.relative_luminance);
      data.observations.push_back(o);
    }
  }
  const auto first = static_cast<Eigen::Index>(traced.elements.size());
  for (size_t r = 0; r < readings.size(); ++r) {
    Reading& reading = readings[r];
    const double before = reading.illuminance_lx;
    const double relative = before > 0 ? reading.sigma_lx / before : 0;
    const double lx = traced.illuminance_lx.row(first + static_cast<Eigen::Index>(r))
                          .dot(dimming[static_cast<size_t>(reading.state)]);
    reading.illuminance_lx = lx * (1 + relative * normal(rng));
    reading.sigma_lx = relative * lx;
    data.readings.push_back(reading);
  }
  return data;
}

}  // namespace luxfit
