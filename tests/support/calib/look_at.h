// A camera that stands at one point, looks at another and is upright: cam_from_world.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_LOOK_AT_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_LOOK_AT_H_

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace luxfit::support {

inline Eigen::Isometry3d LookAt(const Eigen::Vector3d& from, const Eigen::Vector3d& at) {
  const Eigen::Vector3d forward = (at - from).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d world_from_cam = Eigen::Isometry3d::Identity();
  world_from_cam.linear() << right, forward.cross(right), forward;
  world_from_cam.translation() = from;
  return world_from_cam.inverse();
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_LOOK_AT_H_
