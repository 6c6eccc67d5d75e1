#include "forward/light/light_tracer.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "forward/direct/internal/expect_sensor.h"
#include "forward/direct/internal/luminous_surface.h"
#include "forward/luminaire/internal/direction_sampler.h"
#include "forward/luminaire/internal/expect_luminaire.h"
#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

// Few numbers are drawn of each: a generator whose state is one.
class Generator {
 public:
  explicit Generator(uint64_t seed) : state_(seed) {}
  double Unit() { return UnitFrom(state_ = Mix(state_)); }
  Eigen::Vector2d InSquare() {
    const double u = Unit();
    return {u, Unit()};
  }
  Eigen::Vector4d InCube() {
    Eigen::Vector4d four;
    four << InSquare(), InSquare();
    return four;
  }

 private:
  uint64_t state_;
};

// Point `index` of the additive sequence in four dimensions, from `start`.
Eigen::Vector4d GoldenPoint(double index, const Eigen::Vector4d& start) {
  const Eigen::Vector4d x = start + index * Eigen::Map<const Eigen::Vector4d>(kGoldenSteps);
  return x.array() - x.array().floor();
}

// Direct light that a surface takes from one point of a luminaire.
struct TakenLight {
  double lx = 0;              // for all the luminaire's flux
  double density_per_m2 = 0;  // with which a direction drawn by the luminaire's intensity meets this place
};

struct Source {
  LuminousSurface surface;
  DirectionSampler directions;
  bool sends_light = false;  // whether light is followed from it
};

// A place that light from a luminaire meets first.
struct LightPoint {
  bool is_lit = false;
  Eigen::Vector3d position, normal;
  double reflected_lx = 0, density_per_m2 = 0;  // as of TakenLight, but reflected
};

// The end of a path, and the point of the unit square that tells where it goes on to.
struct PathEnd {
  Eigen::Vector3d position, normal;
  Eigen::Vector2d unit;
  const LightPoint* lit = nullptr;  // by luminaire
};

// Density of the cosine's directions at p by the area of q, per m2: cos cos / (pi r^2). 0: one lies behind the other.
double CosineDensity(const Eigen::Vector3d& p, const Eigen::Vector3d& p_normal, const Eigen::Vector3d& q,
                     const Eigen::Vector3d& q_normal) {
  const Eigen::Vector3d to_q = q - p;
  const double p_height = p_normal.dot(to_q), q_height = -q_normal.dot(to_q);
  if (p_height <= 0 || q_height <= 0) return 0;
  return p_height * q_height / (M_PI * std::pow(to_q.squaredNorm(), 2));
}

// Weight of what was drawn with `density` where another way draws it with `other` (balance heuristic). Level with a
// surface the density may round to 0.
double Share(double density, double other) { return other > 0 ? density / (density + other) : 1; }

struct Tracer {
  const Scene& scene;
  const RayScene& rays;
  const Eigen::VectorXd& albedo;
  std::vector<Source> sources;

  // Returns what is taken without asking whether anything lies between.
  TakenLight TakenUnhidden(const Source& source, const Eigen::Vector3d& from, const Eigen::Vector3d& p,
                           const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d to_lamp = from - p;
    const double height = normal.dot(to_lamp);
    if (height <= 0) return {};
    const double r = to_lamp.norm(), r3 = r * r * r;
    const Eigen::Vector3d direction = -to_lamp / r;
    const double cd_per_lm = source.surface.IntensityTowards(direction).cd_per_lm;
    TakenLight taken;
    taken.lx = source.surface.luminaire().flux_lm * cd_per_lm * height / r3;
    if (source.sends_light) taken.density_per_m2 = source.directions.Density(direction) * height / r3;
    return taken;
  }

  // The point of the luminaire is drawn from its surface.
  TakenLight Taken(const Source& source, const Eigen::Vector2d& unit, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d from = source.surface.PointAt(unit);
    const TakenLight taken = TakenUnhidden(source, from, p, normal);
    if (taken.lx == 0 || rays.Occluded(LiftedOff(p, normal), from)) return {};
    return taken;
  }

  LightPoint Follow(const Source& source, const Eigen::Vector2d& place, const Eigen::Vector2d& unit) const {
    LightPoint point;
    const Eigen::Vector3d from = source.surface.PointAt(place),
                          direction = source.directions.DirectionAt(unit);
    // As far off as a shadow ray ends before a luminaire: one that lies in a surface shines away from it.
    const RayHit hit = rays.Trace(LiftedOff(from, direction), direction);
    if (hit.facet < 0 || !hit.front) return point;
    const Facet& facet = scene.facets[static_cast<size_t>(hit.facet)];
    point.position = facet.PointAt(hit.u, hit.v);
    point.normal = facet.Normal();
    const TakenLight taken = TakenUnhidden(source, from, point.position, point.normal);
    point.reflected_lx = albedo[facet.material] * taken.lx;
    point.density_per_m2 = taken.density_per_m2;
    point.is_lit = point.reflected_lx > 0;
    return point;
  }

  // Returns what a place takes from a lit point, weighed against directions from the place.
  double Connected(const LightPoint& lit, const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
    if (!lit.is_lit) return 0;
    const double density = CosineDensity(p, normal, lit.position, lit.normal);
    if (density == 0 || rays.Occluded(LiftedOff(p, normal), LiftedOff(lit.position, lit.normal))) return 0;
    return lit.reflected_lx * Share(density, lit.density_per_m2);
  }

  // Adds the light of paths that leave a sensor together, by luminaire. `lit`: the first places of each luminaire's
  // light, if it is followed, luminaires of a path together.
  void AddPaths(const Sensor& sensor, int paths, const Eigen::Vector2d& start,
                const std::vector<LightPoint>& lit, Generator& rng,
                Eigen::Ref<Eigen::VectorXd> sum_lx) const {
    std::vector<PathEnd> ends;
    ends.reserve(static_cast<size_t>(paths));
    for (int i = 0; i < paths; ++i)
      ends.push_back({sensor.position, sensor.normal, PlasticPoint(i, start),
                      lit.data() + static_cast<size_t>(i) * sources.size()});
    for (int surfaces = 1; !ends.empty(); ++surfaces) {
      const Eigen::Vector2d surface = rng.InSquare();
      const Eigen::Vector4d hemisphere = rng.InCube();
      double reflected = rng.Unit();
      size_t met = 0, gone_on = 0;
      for (const PathEnd& each : ends) {
        const PathEnd end = each;  // its place may be taken
        for (size_t k = 0; k < sources.size(); ++k)
          sum_lx[static_cast<Eigen::Index>(k)] += Connected(end.lit[k], end.position, end.normal);
        const Eigen::Vector3d direction = FrameOf(end.normal) * LiftedFromDisc(end.unit[0], end.unit[1]);
        const RayHit hit = rays.Trace(LiftedOff(end.position, end.normal), direction);
        if (hit.facet < 0 || !hit.front) continue;
        const Facet& facet = scene.facets[static_cast<size_t>(hit.facet)];
        const Eigen::Vector3d p = facet.PointAt(hit.u, hit.v), normal = facet.Normal();
        const double rho = albedo[facet.material];
        AddTaken(PlasticPoint(static_cast<double>(met++), surface), rho, p, normal,
                 CosineDensity(end.position, end.normal, p, normal), sum_lx);
        // Systematic sampling: as many go on as the sum of reflectances, but for one.
        const double before = std::floor(reflected);
        reflected += rho;
        if (std::floor(reflected) == before) continue;
        // Steps of their own: with those by which the place was drawn, directions would follow from it.
        const Eigen::Vector4d four = GoldenPoint(static_cast<double>(gone_on), hemisphere);
        ends[gone_on++] = {p, normal, surfaces % 2 == 0 ? four.head<2>() : four.tail<2>(), end.lit};
      }
      ends.resize(gone_on);
    }
  }

  // Adds what a place reflects of each luminaire's direct light, weighed against light that is followed. `density`:
  // with which the path met the place.
  void AddTaken(const Eigen::Vector2d& unit, double rho, const Eigen::Vector3d& p,
                const Eigen::Vector3d& normal, double density, Eigen::Ref<Eigen::VectorXd> sum_lx) const {
    for (size_t k = 0; k < sources.size(); ++k) {
      const TakenLight taken = Taken(sources[k], unit, p, normal);
      if (taken.lx > 0)
        sum_lx[static_cast<Eigen::Index>(k)] += rho * taken.lx * Share(density, taken.density_per_m2);
    }
  }
};

// Returns how much more densely a luminaire's light lies on the surfaces that it meets first than if it lay evenly on all
// of them: S = A int p^2 dA / (int p dA)^2, p: density of its directions by area. 1: evenly; 0: it meets none.
double ConcentrationOf(const Tracer& tracer, const Source& source) {
  constexpr int kDirections = 256;
  double area_m2 = 0, sum_per_m2 = 0, met = 0;
  for (const Facet& facet : SurfaceFacets(tracer.scene)) area_m2 += facet.AreaM2();
  for (int i = 0; i < kDirections; ++i) {
    const Eigen::Vector4d four = GoldenPoint(i, Eigen::Vector4d::Constant(0.5));
    const LightPoint lit = tracer.Follow(source, four.tail<2>(), four.head<2>());
    sum_per_m2 += lit.density_per_m2;
    met += lit.density_per_m2 > 0 ? 1 : 0;
  }
  return met > 0 ? area_m2 * sum_per_m2 * kDirections / (met * met) : 0;
}

// Returns the concentration from which on it pays to follow the light of so many luminaires.
//
// To follow it divides the variance by about S / 2 (measured in five rooms). A place of a path takes one ray, and a
// shadow ray for each luminaire; the connections of what is followed cost twice as much again (measured).
double WorthwhileConcentration(size_t luminaires) {
  const auto n = static_cast<double>(luminaires);
  return 2 * (1 + 3 * n) / (1 + n);
}

void AddSources(const std::vector<Luminaire>& luminaires, Tracer& tracer) {
  const double worthwhile = WorthwhileConcentration(luminaires.size());
  for (const Luminaire& luminaire : luminaires) {
    tracer.sources.push_back({LuminousSurface(luminaire), DirectionSampler(luminaire), true});
    tracer.sources.back().sends_light = ConcentrationOf(tracer, tracer.sources.back()) > worthwhile;
  }
}

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
  AddSources(luminaires, tracer);
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
    const Eigen::Vector2d surface = rng.InSquare(), hemisphere = rng.InSquare();
    const Eigen::Vector4d light = rng.InCube();
    Eigen::VectorXd direct_lx = Eigen::VectorXd::Zero(lamps), indirect_lx = direct_lx;
    std::vector<LightPoint> lit(static_cast<size_t>(paths) * tracer.sources.size());
    for (int i = 0; i < paths; ++i) {
      const Eigen::Vector2d unit = PlasticPoint(i, surface);
      const Eigen::Vector4d four = GoldenPoint(i, light);
      for (size_t k = 0; k < tracer.sources.size(); ++k) {
        const Source& source = tracer.sources[k];
        direct_lx[static_cast<Eigen::Index>(k)] +=
            tracer.Taken(source, unit, sensor.position, sensor.normal).lx;
        if (source.sends_light)
          lit[static_cast<size_t>(i) * tracer.sources.size() + k] =
              tracer.Follow(source, four.tail<2>(), four.head<2>());
      }
    }
    tracer.AddPaths(sensor, paths, hemisphere, lit, rng, indirect_lx);
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
