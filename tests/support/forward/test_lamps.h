// Luminaires two metres up that shine down, for tests of direct light.
#ifndef LUXFIT_TESTS_SUPPORT_FORWARD_TEST_LAMPS_H_
#define LUXFIT_TESTS_SUPPORT_FORWARD_TEST_LAMPS_H_

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <vector>

#include "forward/direct/direct_light.h"
#include "forward/luminaire/photometry.h"
#include "tests/support/closed_forms.h"

namespace luxfit::support {

inline const Eigen::Vector3d kUp(0, 0, 1);

inline Luminaire Lamp(Distribution distribution, LuminaireShape shape, double size_along = 0,
                      double size_across = 0) {
  Luminaire lamp;
  lamp.position = Eigen::Vector3d(0, 0, 2);
  lamp.distribution = distribution;
  lamp.shape = shape;
  lamp.size_m = {size_along, size_across};
  return lamp;
}

// Different in every direction; steps of 30 degrees, so that a test's small step rarely meets a kink.
inline std::shared_ptr<const IntensityTable> LopsidedTable() {
  std::vector<double> c_rad, gamma_rad, intensity;
  for (int i = 0; i < 12; ++i) c_rad.push_back(i * kPi / 6);
  for (int i = 0; i <= 6; ++i) gamma_rad.push_back(i * kPi / 6);
  for (const double c : c_rad) {
    for (const double g : gamma_rad)
      intensity.push_back(2 + std::sin(g) * (std::cos(c) + 0.5 * std::sin(c)) + 0.8 * std::cos(g));
  }
  return std::make_shared<IntensityTable>(
      Normalized(ExpandPlanes(c_rad, gamma_rad, intensity, PlaneSymmetry::kNone)));
}

inline double LxPerLm(const Luminaire& lamp, const Eigen::Vector3d& p, const Eigen::Vector3d& normal = kUp) {
  return DirectIlluminancePerLumen(lamp, p, normal).lx_per_lm;
}

// A receiver at the origin, turned so that its plane passes the lamp's centre at `depth` of what would just
// leave the lamp whole (1) or hide it (-1).
inline Eigen::Vector3d NormalAtDepth(const Luminaire& lamp, const Eigen::Vector3d& away, double depth) {
  const LuminaireAxes axes = AxesOf(lamp);
  const Eigen::Vector3d towards = lamp.position.normalized();
  const Eigen::Vector3d side = (away - away.dot(towards) * towards).normalized();
  const auto past = [&](double angle) {
    const Eigen::Vector3d n = std::sin(angle) * towards + std::cos(angle) * side;
    const double a = n.dot(axes.along), b = n.dot(axes.across);
    const double reach = lamp.shape == LuminaireShape::kDisc
                             ? lamp.size_m[0] / 2 * std::hypot(a, b)
                             : (lamp.size_m[0] * std::abs(a) + lamp.size_m[1] * std::abs(b)) / 2;
    return n.dot(lamp.position) - depth * reach;
  };
  double low = -kPi / 2, high = kPi / 2;
  for (int k = 0; k < 60; ++k) (past(0.5 * (low + high)) > 0 ? high : low) = 0.5 * (low + high);
  return std::sin(low) * towards + std::cos(low) * side;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_FORWARD_TEST_LAMPS_H_
