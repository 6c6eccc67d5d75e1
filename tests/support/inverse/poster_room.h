// A room with a poster that its model does not have, lit by the unbiased light tracer: the truth shares no
// patch, no form factor and no material with what is estimated from it.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_POSTER_ROOM_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_POSTER_ROOM_H_

#include <Eigen/Core>
#include <random>
#include <vector>

#include "forward/light/light_tracer.h"
#include "inverse/model/light_state.h"
#include "tests/support/scenes.h"

namespace luxfit::support {

constexpr double kPosterAlbedo = 0.15;
constexpr double kPosterRoomScale = 2e-3;  // relative luminance per cd/m2

// 4 m x 3 m x 2.5 m: walls, floor, ceiling.
inline Scene PosterRoomScene(bool with_poster) {
  Scene scene = ClosedRoom({4, 3, 2.5}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  // 2 m x 1.5 m, 1 mm in front of the wall y = 3.
  if (with_poster) AddParallelogram(scene, {1, 2.999, 0.5}, {2, 0, 0}, {0, 0, 1.5}, "poster");
  return scene;
}
inline bool OnPoster(const Eigen::Vector3d& p) {
  return p.y() > 2.9 && p.x() > 1 && p.x() < 3 && p.z() > 0.5 && p.z() < 2;
}
inline Eigen::VectorXd PosterRoomAlbedo() { return Eigen::Vector3d(0.6, 0.3, 0.8); }

inline std::vector<Luminaire> PosterRoomLamps() {
  std::vector<Luminaire> lamps(3);
  const std::vector<Eigen::Vector3d> places = {{0.8, 0.9, 2.2}, {3.1, 1.2, 2.1}, {2.1, 2.2, 2.3}};
  for (size_t k = 0; k < lamps.size(); ++k) {
    lamps[k].id = std::string(1, static_cast<char>('A' + k));
    lamps[k].position = places[k];
    lamps[k].distribution = Distribution::kCosinePower;
    lamps[k].cosine_exponent = 1;
    lamps[k].flux_lm = 1000 + 300 * static_cast<double>(k);
  }
  return lamps;
}

inline Room PosterRoomModel(double element_size_m = 0.5) {
  RoomOptions options;
  options.patches.patch_size_m = 0.5;
  options.patches.element_size_m = element_size_m;
  return MakeRoom(PosterRoomScene(false), options);
}

inline LightState PosterRoomLight() {
  LightState light;
  light.luminaires = PosterRoomLamps();
  light.free.assign(light.luminaires.size(), {});
  light.albedo = PosterRoomAlbedo();
  light.albedo_free.assign(3, true);
  light.camera_scale = kPosterRoomScale;
  return light;
}

// Every element of `room` seen in every state (each lamp alone), with relative noise.
inline LightData PosterRoomData(const Room& room, double noise, int paths, std::mt19937_64& rng) {
  const Scene truth = PosterRoomScene(true);
  const std::vector<Luminaire> lamps = PosterRoomLamps();
  Eigen::VectorXd albedo(4);
  albedo << PosterRoomAlbedo(), kPosterAlbedo;
  std::vector<Sensor> sensors;
  sensors.reserve(room.patches.elements.size());
  for (const Element& element : room.patches.elements) {
    // In front of the poster, not behind it.
    sensors.push_back({element.center + 0.002 * element.normal, element.normal});
  }
  LightTracerOptions options;
  options.paths_per_sensor = paths;
  const TracedIlluminance traced = TraceIlluminance(truth, RayScene(truth), lamps, albedo, sensors, options);
  LightData data;
  std::normal_distribution<double> error(0, noise);
  for (Eigen::Index s = 0; s < 3; ++s) {
    data.dimming.emplace_back(Eigen::VectorXd::Unit(3, s));
    for (size_t e = 0; e < sensors.size(); ++e) {
      const Patch& patch = room.patches.patches[static_cast<size_t>(room.patches.elements[e].patch)];
      const double rho = OnPoster(room.patches.elements[e].center) ? kPosterAlbedo : albedo[patch.material];
      const Eigen::Index i = static_cast<Eigen::Index>(e);
      const double lx = traced.direct(i, s) + traced.indirect(i, s);
      Observation o;
      o.element = static_cast<int>(e);
      o.view = -1;
      o.state = static_cast<int>(s);
      o.pixels = 100;
      o.relative_luminance = kPosterRoomScale * rho * lx / 3.14159265358979323846 * (1 + error(rng));
      o.variance = std::pow(noise * o.relative_luminance, 2);
      data.observations.push_back(o);
    }
  }
  return data;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_POSTER_ROOM_H_
