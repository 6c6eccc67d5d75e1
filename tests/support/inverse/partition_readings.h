// Readings on the floor on both sides of an opaque partition, from closed forms.
//
//   E = Phi h / (4 pi r^3) for an isotropic point that the sensor sees, 0 for one behind the partition
//
// The partition: x = 0, |y| <= 1.5 m, 0 <= z <= 1.6 m. Whether it stands between is asked of its plane, not
// of a ray tracer.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_PARTITION_READINGS_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_PARTITION_READINGS_H_

#include <cmath>

#include "inverse/model/light_state.h"
#include "tests/support/closed_forms.h"
#include "tests/support/scenes.h"

namespace luxfit::support {

inline Scene PartitionScene() {
  Scene scene;
  AddParallelogram(scene, {0, -1.5, 0}, {0, 3, 0}, {0, 0, 1.6}, "partition");
  // Far away, so that a luminaire may be anywhere about the partition.
  AddParallelogram(scene, {-3, -3, -0.01}, {6, 0, 0}, {0, 6, 0}, "floor");
  AddParallelogram(scene, {-3, -3, 2.8}, {0, 6, 0}, {6, 0, 0}, "ceiling");
  return scene;
}

inline bool PartitionBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  if (a.x() * b.x() >= 0) return false;
  const Eigen::Vector3d p = a + a.x() / (a.x() - b.x()) * (b - a);
  return std::abs(p.y()) <= 1.5 && p.z() >= 0 && p.z() <= 1.6;
}

inline LightData PartitionReadings(const Eigen::Vector3d& lamp, double flux_lm) {
  LightData data;
  data.dimming = {Eigen::VectorXd::Ones(1)};
  for (int i = 0; i < 14; ++i) {
    for (int j = 0; j < 14; ++j) {
      const Eigen::Vector3d p(-2.6 + 0.4 * i, -2.6 + 0.4 * j, 0);
      const Eigen::Vector3d to_lamp = lamp - p;
      const double lx =
          PartitionBetween(p, lamp) ? 0 : flux_lm * to_lamp.z() / (4 * kPi * std::pow(to_lamp.norm(), 3));
      data.readings.push_back({{p, {0, 0, 1}, {}}, 0, lx, 0.02 * lx + 0.2, true});
    }
  }
  return data;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_PARTITION_READINGS_H_
