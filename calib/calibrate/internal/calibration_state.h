// What an adjustment of cameras starts from and ends with, whichever solver does it.
//
//   p_in_cam = cam_from_rig_c * rig_from_target_s * (p + bend(p)),  residual = f_c(p_in_cam) - seen, px
//   bend(p) = (0, 0, 4 warp_x x (1 - x) + 4 warp_y y (1 - y)),  x, y in 0..1 over the grid (mrcal's)
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_STATE_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_STATE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include "calib/calibrate/calibration_input.h"
#include "calib/lens/internal/lens_function.h"

namespace luxfit {

struct CornerObservation {
  int image = 0, camera = 0, set = 0, point = 0;  // sets are numbered 0, 1, ... here
  Eigen::Vector2d pixel;
  double weight = 1;  // 1 / sigma, relative to the median corner's
  bool used = true;   // false: an outlier
};

// The input in the form that solvers take; refers to it.
struct CalibrationProblem {
  const CalibrationInput* input = nullptr;
  int sets = 0;
  std::vector<int> set_of_image;
  std::vector<CornerObservation> corners;  // by set, camera, point
};

struct CalibrationState {
  LensFunction lens;
  std::vector<std::vector<double>> intrinsics;     // by camera
  std::vector<Eigen::Isometry3d> cam_from_rig;     // by camera; the first is the identity
  std::vector<Eigen::Isometry3d> rig_from_target;  // by set
  Eigen::Vector2d warp_m = Eigen::Vector2d::Zero();
};

struct SolvedState {
  bool ok = false;
  CalibrationState state;
  std::string message;  // why not
};

struct SolveSelection {
  bool distortion = true;  // false: only focal lengths and centre
  bool warp = false;
};

// Derivatives of the weighted residuals and of the regularisation, and where the unknowns stand: lens
// parameters of camera c from FirstFreeParameter on, then Rodrigues vector and translation of each pose.
struct LinearizedState {
  Eigen::SparseMatrix<double> jacobian;  // rows: measurements; columns: unknowns
  std::vector<int> intrinsics_at;        // by camera
  std::vector<int> cam_from_rig_at;      // by camera; -1: held
  std::vector<int> rig_from_target_at;   // by set
  int warp_at = -1;
};

CalibrationProblem MakeProblem(const CalibrationInput& input);

Eigen::Vector3d TargetPoint(const CalibrationTarget& target, int point, const Eigen::Vector2d& warp_m);

// 2 x corners, px, predicted - seen, of outliers too; not finite where the lens has no image.
Eigen::Matrix2Xd Residuals(const CalibrationProblem& problem, const CalibrationState& state);

bool IsFinite(const CalibrationState& state);

// Rodrigues vector and translation, as libmrcal has them.
Eigen::Matrix<double, 6, 1> RodriguesOf(const Eigen::Isometry3d& pose);
Eigen::Isometry3d PoseOf(const double* rodrigues_and_translation);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_STATE_H_
