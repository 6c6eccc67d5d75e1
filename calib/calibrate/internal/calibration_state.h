// Holds the start and the result of an adjustment of cameras, for every solver alike.
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
  double weight = 1;  // the median corner's sigma divided by this one's
  bool used = true;   // false: an outlier
};

// Holds the input in the form that solvers take, by reference: the input must outlive it.
struct CalibrationProblem {
  const CalibrationInput* input = nullptr;
  int sets = 0;
  std::vector<int> set_of_image;
  std::vector<CornerObservation> corners;  // by set, camera, point
};

struct CalibrationState {
  LensFunction lens;
  std::vector<std::vector<double>> intrinsics;     // by camera
  std::vector<Eigen::Isometry3d> cam_from_rig;     // by camera; identity for the first
  std::vector<Eigen::Isometry3d> rig_from_target;  // by set
  Eigen::Vector2d warp_m = Eigen::Vector2d::Zero();
};

struct SolvedState {
  bool ok = false;
  CalibrationState state;
  std::string message;  // says why the solver failed
};

struct SolveSelection {
  bool distortion = true;  // false: fit focal lengths and centre only
  bool warp = false;
};

// Holds the derivatives of the weighted residuals and of the regularisation, and the places of the unknowns.
// Unknowns of camera c: lens parameters from FirstFreeParameter on. Unknowns of a pose: Rodrigues vector,
// then translation.
struct LinearizedState {
  Eigen::SparseMatrix<double> jacobian;  // rows: measurements; columns: unknowns
  std::vector<int> intrinsics_at;        // by camera
  std::vector<int> cam_from_rig_at;      // by camera; -1: held
  std::vector<int> rig_from_target_at;   // by set
  int warp_at = -1;
};

// Returns the problem of an input: corners in order of set, camera and point, weighted by their sigmas.
CalibrationProblem MakeProblem(const CalibrationInput& input);

// Returns a point of the target, bent by `warp_m` where the target is a grid; metres.
Eigen::Vector3d TargetPoint(const CalibrationTarget& target, int point, const Eigen::Vector2d& warp_m);

// Returns the residuals of all corners, outliers included: 2 x corners, px, predicted - seen. Not finite
// where the lens has no image.
Eigen::Matrix2Xd Residuals(const CalibrationProblem& problem, const CalibrationState& state);

bool IsFinite(const CalibrationState& state);

// Returns whether every camera has a corner in use.
bool SeesEveryCamera(const CalibrationProblem& problem);

// Returns the Rodrigues vector (rad) and translation (m) of a pose, libmrcal's form; PoseOf inverts it.
Eigen::Matrix<double, 6, 1> RodriguesOf(const Eigen::Isometry3d& pose);
Eigen::Isometry3d PoseOf(const double* rodrigues_and_translation);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_STATE_H_
