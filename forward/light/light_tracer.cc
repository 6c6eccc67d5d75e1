#include "forward/light/light_tracer.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <stdexcept>

#include "forward/direct/internal/expect_sensor.h"
#include "forward/direct/internal/luminous_surface.h"
#include "forward/luminaire/internal/expect_luminaire.h"
#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

using Generator = std::mt19937_64;

double Uniform(Generator& rng) { return UnitFrom(rng()); }

// Returns the direct light from one point of a luminaire's surface, taken for all its flux.
double DirectLx(const RayScene& rays, const LuminousSurface& surface, const Eigen::Vector3d& p,
                const Eigen::Vector3d& normal, const Eigen::Vector2d& unit) {
  const Eigen::Vector3d point = surface.PointAt(unit), to_lamp = point - p;
  const double height = normal.dot(to_lamp);
  if (height <= 0) return 0;
  const double r = to_lamp.norm();
  const double cd_per_lm = surface.IntensityTowards(-to_lamp / r).cd_per_lm;
  if (cd_per_lm == 0 || rays.Occluded(LiftedOff(p, normal), point)) return 0;
  return surface.luminaire().flux_lm * cd_per_lm * height / (r * r * r);
}

struct Tracer {
  const Scene& scene;
  const RayScene& rays;
  const Eigen::VectorXd& albedo;
  std::vector<LuminousSurface> sources;

  // Adds the light of one path, by luminaire.
  void AddPath(const Sensor& sensor, const Eigen::Vector2d& first, Generator& rng,
               Eigen::Ref<Eigen::VectorXd> sum_lx) const {
    Eigen::Vector3d p = sensor.position, normal = sensor.normal;
    Eigen::Vector2d unit = first;
    while (true) {
      const Eigen::Vector3d direction = FrameOf(normal) * LiftedFromDisc(unit[0], unit[1]);
      const RayHit hit = rays.Trace(LiftedOff(p, normal), direction);
      if (hit.facet < 0 || !hit.front) return;
      const Facet& facet = scene.facets[static_cast<size_t>(hit.facet)];
      p = facet.PointAt(hit.u, hit.v);
      normal = facet.Normal();
      const double rho = albedo[facet.material];
      for (size_t k = 0; k < sources.size(); ++k) {
        sum_lx[static_cast<Eigen::Index>(k)] +=
            rho * DirectLx(rays, sources[k], p, normal, {Uniform(rng), Uniform(rng)});
      }
      if (Uniform(rng) >= rho) return;
      unit = {Uniform(rng), Uniform(rng)};
    }
  }
};

// Holds the mean and its standard error over columns (replicates), by row.
struct MeanAndSigma {
  Eigen::RowVectorXd mean, sigma;
};
MeanAndSigma Summarise(const Eigen::MatrixXd& runs) {
  const double n = static_cast<double>(runs.cols());
  const Eigen::VectorXd mean = runs.rowwise().mean();
  const Eigen::VectorXd squares = (runs.colwise() - mean).rowwise().squaredNorm();
  return {mean.transpose(), (squares / (n * (n - 1))).cwiseSqrt().transpose()};
}

}  // namespace

TracedIlluminance TraceIlluminance(const Scene& scene, const RayScene& rays,
                                   const std::vector<Luminaire>& luminaires, const Eigen::VectorXd& albedo,
                                   const std::vector<Sensor>& sensors, const LightTracerOptions& options) {
  if (!(albedo.array() >= 0).all() || !(albedo.array() < 1).all())
    throw std::invalid_argument("TraceIlluminance: expected reflectances in [0, 1)");
  if (albedo.size() < static_cast<Eigen::Index>(scene.materials.size()))
    throw std::invalid_argument("TraceIlluminance: expected a reflectance for every material");
  if (options.replicates < 2 || options.paths_per_sensor < options.replicates)
    throw std::invalid_argument("TraceIlluminance: expected paths_per_sensor >= replicates >= 2");
  ExpectValid(luminaires);
  ExpectValid(sensors);
  Tracer tracer{scene, rays, albedo, {}};
  for (const Luminaire& luminaire : luminaires) tracer.sources.emplace_back(luminaire);

  const Eigen::Index lamps = static_cast<Eigen::Index>(luminaires.size());
  const size_t replicates = static_cast<size_t>(options.replicates);
  const int paths = options.paths_per_sensor / options.replicates;
  // For each sensor: luminaires x replicates.
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(lamps, options.replicates);
  std::vector<Eigen::MatrixXd> direct(sensors.size(), none), indirect(sensors.size(), none);
  tbb::parallel_for(size_t{0}, sensors.size() * replicates, [&](size_t task) {
    const Sensor& sensor = sensors[task / replicates];
    const Eigen::Index run = static_cast<Eigen::Index>(task % replicates);
    Generator rng(Mix(Mix(options.seed) + task));
    const Eigen::Vector2d surface(Uniform(rng), Uniform(rng)), hemisphere(Uniform(rng), Uniform(rng));
    Eigen::VectorXd direct_lx = Eigen::VectorXd::Zero(lamps), indirect_lx = direct_lx;
    for (int i = 0; i < paths; ++i) {
      const Eigen::Vector2d unit = PlasticPoint(i, surface);
      for (Eigen::Index k = 0; k < lamps; ++k) {
        direct_lx[k] +=
            DirectLx(rays, tracer.sources[static_cast<size_t>(k)], sensor.position, sensor.normal, unit);
      }
      tracer.AddPath(sensor, PlasticPoint(i, hemisphere), rng, indirect_lx);
    }
    direct[task / replicates].col(run) = direct_lx / paths;
    indirect[task / replicates].col(run) = indirect_lx / paths;
  });

  const Eigen::MatrixXd empty(static_cast<Eigen::Index>(sensors.size()), lamps);
  TracedIlluminance result{empty, empty, empty, empty};
  for (size_t s = 0; s < sensors.size(); ++s) {
    const Eigen::Index row = static_cast<Eigen::Index>(s);
    const MeanAndSigma at_once = Summarise(direct[s]), reflected = Summarise(indirect[s]);
    result.direct.row(row) = at_once.mean;
    result.direct_sigma.row(row) = at_once.sigma;
    result.indirect.row(row) = reflected.mean;
    result.indirect_sigma.row(row) = reflected.sigma;
  }
  return result;
}

}  // namespace luxfit
