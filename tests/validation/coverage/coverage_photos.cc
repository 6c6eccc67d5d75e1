#include "tests/validation/coverage/coverage_photos.h"

#include <cmath>

#include "forward/light/light_tracer.h"
#include "inverse/observe/observe.h"
#include "inverse/study/degrade.h"

namespace luxfit::coverage {
namespace {

constexpr int kPixels = 100;
constexpr double kOffSurfaceM = 1e-4;  // so that a path does not start inside its surface

double DirectLx(const Luminaire& luminaire, const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d from_luminaire = p - luminaire.position;
  const double r = from_luminaire.norm();
  const double cosine_gamma = luminaire.aim.dot(from_luminaire) / r,
               cosine_theta = -normal.dot(from_luminaire) / r;
  if (cosine_gamma <= 0 || cosine_theta <= 0) return 0;
  const double m = luminaire.cosine_exponent;
  const double cd_per_lm = (m + 1) * std::pow(cosine_gamma, m) / (2 * M_PI);
  return luminaire.flux_lm * cd_per_lm * cosine_theta / (r * r);
}

Eigen::VectorXd DirectLx(const LightState& light, const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
  Eigen::VectorXd lx(static_cast<Eigen::Index>(light.luminaires.size()));
  for (size_t k = 0; k < light.luminaires.size(); ++k)
    lx[static_cast<Eigen::Index>(k)] = DirectLx(light.luminaires[k], p, normal);
  return lx;
}

// Returns the point where the line from p along `direction` meets the facet's plane.
Eigen::Vector3d OnFacet(const Facet& facet, const Eigen::Vector3d& p, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d normal = facet.Normal();
  return p + normal.dot(facet.origin - p) / normal.dot(direction) * direction;
}

const Facet& RealFacetOf(const Setup& setup, const RealRoom& real, int element) {
  return real.scene.facets[static_cast<size_t>(setup.room.patches.PatchOf(element).facet)];
}

std::vector<Eigen::Vector3d> PointsOf(const Setup& setup, int element) {
  const Element& of = setup.room.patches.elements[static_cast<size_t>(element)];
  return ProbesOf(of, setup.room.patches.IsTriangle(of.patch));
}

Eigen::MatrixXd IndirectLx(const Setup& setup, const RealRoom& real, const std::vector<Sensor>& sensors,
                           int paths, uint64_t seed) {
  LightTracerOptions options;
  options.paths_per_sensor = paths;
  options.replicates = 2;  // the fewest: their spread is not used
  options.seed = seed;
  return TraceIlluminance(real.scene, RayScene(real.scene), setup.light.luminaires, real.albedo, sensors,
                          options)
      .indirect;
}

// Returns the indirect light of every observed element: elements x luminaires.
Eigen::MatrixXd IndirectOfElements(const Setup& setup, const RealRoom& real, uint64_t seed) {
  constexpr int kPoints = 4, kPathsPerPoint = 512;  // 0.5 to 1 % of the indirect light
  std::vector<Sensor> sensors;
  sensors.reserve(setup.elements.size() * kPoints);
  for (const int e : setup.elements) {
    const Facet& facet = RealFacetOf(setup, real, e);
    const Eigen::Vector3d normal = facet.Normal();
    for (const Eigen::Vector3d& p : PointsOf(setup, e))
      sensors.push_back({OnFacet(facet, p, normal) + kOffSurfaceM * normal, normal, {}});
  }
  const Eigen::MatrixXd at_points = IndirectLx(setup, real, sensors, kPathsPerPoint, seed);
  const auto elements = static_cast<Eigen::Index>(setup.elements.size());
  Eigen::MatrixXd mean(elements, at_points.cols());
  for (Eigen::Index i = 0; i < elements; ++i)
    mean.row(i) = at_points.middleRows(i * kPoints, kPoints).colwise().mean();
  return mean;
}

// Returns what an errorless meter shows at each reading's real place.
Eigen::VectorXd TrueReadingsLx(const Setup& setup, const RealRoom& real, uint64_t seed) {
  constexpr int kPaths = 16384;  // a truth: its own error must be far below the intervals
  std::vector<Sensor> sensors;
  sensors.reserve(setup.readings.size());
  for (size_t r = 0; r < setup.readings.size(); ++r) {
    Sensor sensor = setup.readings[r].sensor;
    sensor.position = real.places.col(static_cast<Eigen::Index>(r));
    sensors.push_back(sensor);
  }
  const Eigen::MatrixXd indirect = IndirectLx(setup, real, sensors, kPaths, seed);
  Eigen::VectorXd lx(indirect.rows());
  for (Eigen::Index r = 0; r < lx.size(); ++r) {
    const Sensor& sensor = sensors[static_cast<size_t>(r)];
    const int state = setup.readings[static_cast<size_t>(r)].state;
    lx[r] = indirect(r, state) +
            DirectLx(setup.light.luminaires[static_cast<size_t>(state)], sensor.position, sensor.normal);
  }
  return lx;
}

bool Sees(const View& view, const Element& element) {
  constexpr double kLeastCosineToAxis = 0.7071, kLeastCosineToNormal = 0.15;
  const Eigen::Vector3d ray = (element.center - view.eye).normalized();
  return ray.dot(view.axis) > kLeastCosineToAxis && -ray.dot(element.normal) > kLeastCosineToNormal;
}

// Returns the mean direct light of the places that the pixels of an element really show, by luminaire.
Eigen::VectorXd SeenDirectLx(const Setup& setup, const RealRoom& real, size_t v, int element) {
  const View& view = setup.views[v];
  const RealView& real_view = real.views[v];
  const Facet& facet = RealFacetOf(setup, real, element);
  const std::vector<Eigen::Vector3d> points = PointsOf(setup, element);
  Eigen::VectorXd sum_lx = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(setup.light.luminaires.size()));
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d direction = real_view.turn * (p - view.eye);
    const Eigen::Vector3d seen = OnFacet(facet, view.eye + real_view.shift_m, direction);
    sum_lx += DirectLx(setup.light, seen, facet.Normal());
  }
  return sum_lx / static_cast<double>(points.size());
}

// Returns the observations of all photos without exposure errors and noise.
std::vector<Observation> ObserveAll(const Setup& setup, const RealRoom& real,
                                    const Eigen::MatrixXd& indirect_lx) {
  std::vector<Observation> observations;
  observations.reserve(setup.views.size() * static_cast<size_t>(indirect_lx.size()));
  for (size_t v = 0; v < setup.views.size(); ++v) {
    for (size_t i = 0; i < setup.elements.size(); ++i) {
      const int e = setup.elements[i];
      if (!Sees(setup.views[v], setup.room.patches.elements[static_cast<size_t>(e)])) continue;
      const Eigen::VectorXd lx =
          SeenDirectLx(setup, real, v, e) + indirect_lx.row(static_cast<Eigen::Index>(i)).transpose();
      const double reflectance = real.albedo[setup.room.patches.PatchOf(e).facet] * real.texture[e];
      for (Eigen::Index s = 0; s < lx.size(); ++s) {
        Observation o;
        o.element = e;
        o.view = static_cast<int>(v);
        o.state = static_cast<int>(s);
        o.pixels = kPixels;
        o.relative_luminance = setup.light.camera_scale * reflectance * lx[s] / M_PI;
        o.relative_rgb.setConstant(o.relative_luminance);
        observations.push_back(o);
      }
    }
  }
  return observations;
}

}  // namespace

RealData TakePhotos(const Setup& setup, const RealRoom& real, const ErrorSizes& sizes, uint64_t seed,
                    std::mt19937_64& rng) {
  RealData taken;
  const double noise_of_pixel = sizes.noise * std::sqrt(kPixels);
  taken.observations = WithPixelNoise(
      WithExposureErrors(ObserveAll(setup, real, IndirectOfElements(setup, real, seed)), sizes.exposure, rng),
      noise_of_pixel, rng);
  taken.reading_lx = TrueReadingsLx(setup, real, seed);
  taken.readings = setup.readings;
  std::normal_distribution<double> normal;
  for (size_t r = 0; r < taken.readings.size(); ++r) {
    const double lx = taken.reading_lx[static_cast<Eigen::Index>(r)];
    taken.readings[r].illuminance_lx = lx * (1 + sizes.reading * normal(rng));
    taken.readings[r].sigma_lx = sizes.reading * lx;
  }
  return taken;
}

LightData DataWithModelError(const Setup& setup, const RealRoom& real, const RealData& taken,
                             double facet_sigma) {
  std::vector<Observation> observations = taken.observations;
  for (Observation& o : observations) {
    const int facet = setup.room.patches.PatchOf(o.element).facet;
    const double factor = 1 + facet_sigma * real.facet_states(facet, o.state);
    o.relative_luminance *= factor;
    o.relative_rgb *= factor;
    o.variance *= factor * factor;
  }
  LightData data;
  const auto states = static_cast<Eigen::Index>(setup.light.luminaires.size());
  data.dimming.reserve(setup.light.luminaires.size());
  for (Eigen::Index s = 0; s < states; ++s) data.dimming.emplace_back(Eigen::VectorXd::Unit(states, s));
  data.observations = MergeViews(observations).observations;
  data.readings = taken.readings;
  return data;
}

}  // namespace luxfit::coverage
