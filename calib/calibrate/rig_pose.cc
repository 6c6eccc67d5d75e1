#include "calib/calibrate/rig_pose.h"

#include <cmath>

namespace luxfit {
namespace {

double SigmaAlong(const Eigen::Vector3d& direction, const Eigen::Matrix3d& covariance) {
  return std::sqrt(direction.dot(covariance * direction));
}

}  // namespace

RigPose RigPoseOf(const CalibratedCamera& camera) {
  const Eigen::Vector3d t = camera.cam_from_rig.translation();
  const Eigen::AngleAxisd turn(camera.cam_from_rig.linear());
  RigPose pose;
  pose.baseline_m = t.norm();
  pose.baseline_sigma_m =
      SigmaAlong(t.normalized(), camera.cam_from_rig_covariance.bottomRightCorner<3, 3>());
  pose.angle_rad = turn.angle();
  pose.angle_sigma_rad = SigmaAlong(turn.axis(), camera.cam_from_rig_covariance.topLeftCorner<3, 3>());
  return pose;
}

}  // namespace luxfit
