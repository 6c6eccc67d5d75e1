// Luxmeter readings on planes without any room, from a closed form that the caller gives.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_PLANE_READINGS_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_PLANE_READINGS_H_

#include <Eigen/Core>
#include <functional>
#include <random>
#include <vector>

#include "inverse/model/light_state.h"

namespace luxfit::support {

// `side` x `side` points over the square of `width_m` round the origin, at `height_m`, facing up.
inline std::vector<Eigen::Vector3d> PlanePoints(int side, double width_m, double height_m) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const Eigen::Vector2d at = width_m * (Eigen::Vector2d(i, j) / (side - 1) - Eigen::Vector2d(0.5, 0.5));
      points.emplace_back(at.x(), at.y(), height_m);
    }
  }
  return points;
}

// Noise relative to the reading, which it is also declared with; 0: exact, declared with 1 %.
inline std::vector<Reading> ReadAt(const std::vector<Eigen::Vector3d>& points,
                                   const std::function<double(const Eigen::Vector3d&)>& illuminance_lx,
                                   double relative_noise, std::mt19937_64& rng, int state = 0) {
  std::normal_distribution<double> normal;
  std::vector<Reading> readings;
  for (const Eigen::Vector3d& p : points) {
    const double lx = illuminance_lx(p), sigma_lx = (relative_noise > 0 ? relative_noise : 0.01) * lx;
    const double noise = normal(rng);
    readings.push_back({{p, {0, 0, 1}}, state, lx * (1 + relative_noise * noise), sigma_lx, true});
  }
  return readings;
}

// A cosine-power point with a free exponent, without photos: where a fit to readings starts.
inline LightState CosinePowerStart(const Eigen::Vector3d& position, double exponent) {
  LightState start;
  start.luminaires.resize(1);
  start.luminaires[0].id = "A";
  start.luminaires[0].position = position;
  start.luminaires[0].distribution = Distribution::kCosinePower;
  start.luminaires[0].cosine_exponent = exponent;
  start.luminaires[0].flux_lm = 500;
  start.free.resize(1);
  start.free[0].exponent = true;
  start.camera_scale_free = false;
  return start;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_PLANE_READINGS_H_
