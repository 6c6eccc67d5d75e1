// Returns the angle between two directions, in rad from 0 to pi; neither needs to be a unit vector.
#ifndef LUXFIT_INVERSE_OBSERVE_INTERNAL_ANGLE_H_
#define LUXFIT_INVERSE_OBSERVE_INTERNAL_ANGLE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace luxfit {

inline double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_INTERNAL_ANGLE_H_
