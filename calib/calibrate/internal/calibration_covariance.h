// From an adjustment's derivatives to the covariance that projections need.
//
// A pose's Rodrigues vector r and translation t move points of the reference frame by the twist
// w = A dr, v = dt - w x t with A the left Jacobian of the rotation; the mean over a camera's images is
// carried into its own frame, to which a rig's own pose adds its twist.
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_COVARIANCE_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_COVARIANCE_H_

#include <vector>

#include "calib/calibrate/internal/calibration_state.h"
#include "calib/lens/projection_uncertainty.h"

namespace luxfit {

struct CalibrationCovariance {
  std::vector<ProjectionCovariance> cameras;  // empty matrices where the corners determine nothing
  Eigen::Vector2d warp_sigma_m = Eigen::Vector2d::Zero();
  // Rotation vector (rad) and translation (m) of cam_from_rig, of its frame's axes; zero of the first.
  std::vector<Eigen::Matrix<double, 6, 1>> cam_from_rig_sigma;
};

CalibrationCovariance CovarianceOf(const CalibrationProblem& problem, const CalibrationState& state,
                                   const LinearizedState& linearized, double noise_px);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_COVARIANCE_H_
