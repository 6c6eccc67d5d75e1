// Tells how a camera of a rig stands to the rig's first camera, as a person would measure it.
//
//   baseline = |t|,       sigma^2 = u^T C_tt u,   u = t / |t|
//   angle = |log R|,      sigma^2 = a^T C_ww a,   a = axis of R
//
// (R, t) is cam_from_rig; C_tt and C_ww are the blocks of its covariance. The distance of the centres is |t|, because
// R^T t is as long as t. Sigmas are of first order: they mean little where a value is not several times its sigma. They are NaN
// where the calibration determines no covariance, and 0 for the first camera.
#ifndef LUXFIT_CALIB_CALIBRATE_RIG_POSE_H_
#define LUXFIT_CALIB_CALIBRATE_RIG_POSE_H_

#include "calib/calibrate/calibration.h"

namespace luxfit {

struct RigPose {
  double baseline_m = 0, baseline_sigma_m = 0;  // between the centres of the two cameras
  double angle_rad = 0, angle_sigma_rad = 0;    // by which one is turned against the other
};

RigPose RigPoseOf(const CalibratedCamera& camera);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_RIG_POSE_H_
