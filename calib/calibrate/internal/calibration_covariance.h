// Converts the derivatives of an adjustment to the covariance that projections need.
//
//   w = A dr,  v = dt - w x t,   A: left Jacobian of the rotation
// A pose's Rodrigues vector r and translation t move points of the reference frame by this twist (w, v). The
// mean twist over a camera's images is carried into the camera's frame. In a rig, the camera's own pose adds
// its twist.
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_COVARIANCE_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_COVARIANCE_H_

#include <vector>

#include "calib/calibrate/internal/calibration_state.h"
#include "calib/lens/projection_uncertainty.h"

namespace luxfit {

struct CalibrationCovariance {
  std::vector<ProjectionCovariance> cameras;  // empty matrices where unknowns are undetermined
  Eigen::Vector2d warp_sigma_m = Eigen::Vector2d::Zero();
  // Holds the covariances of a small rotation vector (rad) and the translation (m) of cam_from_rig, in the camera's axes.
  // Zero for the first camera; NaN where unknowns are undetermined.
  std::vector<Eigen::Matrix<double, 6, 6>> cam_from_rig;
};

// Returns the covariances for noise of `noise_px` per axis in a corner of weight 1.
CalibrationCovariance CovarianceOf(const CalibrationProblem& problem, const CalibrationState& state,
                                   const LinearizedState& linearized, double noise_px);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_COVARIANCE_H_
