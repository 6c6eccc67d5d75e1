// Paths of light in an empty box with a corner at the origin, without a mesh, a form factor or a ray tracer of luxfit.
//
// Metres. Normals point into the box.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_BOX_PATHS_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_BOX_PATHS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/support/closed_forms.h"

namespace luxfit::support {

// Maps two numbers in [0, 1) to a direction about the normal, with the cosine's density.
inline Eigen::Vector3d CosineWeighted(const Eigen::Vector3d& normal, double radial, double azimuthal) {
  const double r = std::sqrt(radial), phi = 2 * kPi * azimuthal;
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  return r * std::cos(phi) * u + r * std::sin(phi) * v + std::sqrt(std::max(0.0, 1 - r * r)) * normal;
}

// Returns where a ray from inside the box ends, and the wall's normal there.
inline std::pair<Eigen::Vector3d, Eigen::Vector3d> HitBox(const Eigen::Vector3d& size_m,
                                                          const Eigen::Vector3d& p,
                                                          const Eigen::Vector3d& direction) {
  double nearest = 1e9;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) continue;
    const double t = ((direction[axis] > 0 ? size_m[axis] : 0) - p[axis]) / direction[axis];
    if (t >= nearest) continue;
    nearest = t;
    normal = -Eigen::Vector3d::Unit(axis) * (direction[axis] > 0 ? 1 : -1);
  }
  return {p + nearest * direction, normal};
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_BOX_PATHS_H_
