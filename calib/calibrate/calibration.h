// Calibrates the lenses of cameras, and the poses of a rig's cameras, from images of a board or surveyed
// tags.
//
//   min over lens_c, cam_from_rig_c, rig_from_target_s, bend of
//     sum_corners w^2 |f(lens_c, cam_from_rig_c rig_from_target_s p) - q|^2,   px^2
// w is the median corner's sigma divided by the corner's own. libmrcal minimises it, with its weak
// regularisation of distortion, or OpenCV. No prior is needed: focal lengths are scanned. Wrong corners (more
// than `outlier_sigmas` off) are left out and named. A set that keeps fewer than six is left out whole, and its
// images are named.
//
// The lens is the simplest candidate that images held out support. The sets are divided into k folds. The
// lens of the other folds places each left-out set by the set's own corners, which takes 6 degrees of
// freedom:
//   held-out^2 = sum |r|^2 / sum (2 n - 6)   per axis, over sets; |r| weighted as above
// The error is therefore that of the median corner: compare it with the noise, not with the plain rms.
// A simpler lens is chosen if its held-out^2 exceeds the best one's by no more than the larger of two values.
// One is the standard error of that difference over sets. The other is the square of the best lens' own
// projection uncertainty at the corners.
//
// A small residual alone proves nothing: boards in the middle of the image fit any lens. Held-out error,
// uncertainty of projections and coverage therefore have gates. Both are judged within the image circle of a wide camera
// (calib/calibrate/image_circle.h): beyond it, nothing can be seen. A camera that fails a gate is returned but
// not usable, with a note that says why and names the remedy.
//
// Residuals: predicted - seen, px. "per axis": sqrt(sum |r|^2 / 2 n); "2-D": sqrt(sum |r|^2 / n).
// Source: Zhang (2000), "A flexible new technique for camera calibration"; mrcal 2.2; Hastie, Tibshirani and
// Friedman (2009), section 7.10 (one standard error).
#ifndef LUXFIT_CALIB_CALIBRATE_CALIBRATION_H_
#define LUXFIT_CALIB_CALIBRATE_CALIBRATION_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <string>
#include <vector>

#include "calib/calibrate/calibration_input.h"
#include "calib/calibrate/image_circle.h"
#include "calib/lens/camera.h"
#include "calib/lens/lens_family.h"
#include "calib/lens/projection_uncertainty.h"

namespace luxfit {

enum class CalibrationBackEnd { kMrcal, kOpenCv };

struct CalibrationGates {
  double max_held_out_px = 1.0;       // per axis: sharp corners and a good lens stay well below
  double max_held_out_ratio = 1.5;    // to the fit's noise: more means too many parameters
  double max_sigma_px = 1.0;          // for the projection of a direction ...
  double max_uncertain_share = 0.2;   // ... over more than this part of the image circle
  double min_covered_share = 0.5;     // cells of the image circle (CalibrationCoverage)
  double min_tilt_deg = 10;           // tilt of a flat board, at least once: the focal length needs it
  double questioned_outliers = 0.03;  // share of corners; more is a warning
  double max_outliers = 0.2;          // and more than this a failure
};

struct CalibrateCamerasOptions {
  // Candidates in order of complexity. Empty: opencv4, 5, 8, 12 and two splined lenses, and fisheye where the
  // field of view is wide. A single candidate is taken without a choice.
  std::vector<LensKind> lenses;
  CalibrationBackEnd back_end = CalibrationBackEnd::kMrcal;
  int folds = 5;  // parts into which the sets are divided; fewer where there are fewer sets
  double outlier_sigmas = 4;
  double focal_start_px = 0;  // 0: scanned; else only focal lengths within a factor of 2 are tried
  bool board_may_bend = true;
  CalibrationGates gates;
};

struct CalibrationNote {
  std::string code;    // held_out_error, uncertain_projection, few_images, outliers, image_rejected, ...
  bool fails = false;  // a gate failed: the cameras are not usable
  std::string message, remedy;
};

// Reports where a camera's images hold corners. Lens parameters are determined only there.
struct CalibrationCoverage {
  Eigen::MatrixXi corner_counts;  // 6 x 6 cells, rows from the top
  double covered_share = 0;       // share of the image circle's cells with a corner
  int images = 0;
  // Angle between a flat target's normal and the optical axis; 0 for a room's tags, which do not lie in a
  // plane.
  double max_tilt_deg = 0;
  bool is_flat = true;
  double nearest_m = 0, farthest_m = 0;  // distance to the middle of the seen corners
  std::vector<std::string> lacks;        // one phrase for each gap that more photos should fill
};

struct CalibratedCamera {
  std::string id;
  Camera camera;
  Eigen::Isometry3d cam_from_rig = Eigen::Isometry3d::Identity();  // the first camera is the rig's frame
  // Holds the covariance of a small rotation vector (rad) and the translation (m), in the camera's axes. Zero for the
  // first camera; NaN where unknowns are undetermined.
  Eigen::Matrix<double, 6, 6> cam_from_rig_covariance = Eigen::Matrix<double, 6, 6>::Zero();
  ProjectionCovariance uncertainty;
  ImageCircle circle;
  CalibrationCoverage coverage;
  double uncertain_share = 1;    // share of the circle where the sigma of a direction exceeds the gate
  double median_sigma_px = 0;    // median over the circle, for directions
  std::string uncertain_places;  // names in words the ninths of the image with such places
};

struct ImageCalibration {
  int image = 0;  // index into the input's images
  int corners = 0, outliers = 0;
  double rms_px = 0;  // per axis, over the corners in use
  Eigen::Isometry3d cam_from_target = Eigen::Isometry3d::Identity();
};

struct CornerResidual {
  int image = 0, index = 0;  // index into the input's images; into the target's points
  Eigen::Vector2d residual_px;
  bool is_outlier = false;
};

struct LensScore {
  LensKind kind;
  bool is_fitted = false;
  // Per axis. Held out: NaN where there were too few sets, infinity where the lens has no image of a corner.
  double rms_px = 0, held_out_px = 0;
  int outliers = 0;
  std::string verdict;
};

struct Calibration {
  std::vector<CalibratedCamera> cameras;
  LensKind lens;
  std::vector<LensScore> lenses;  // every candidate tried, in order
  std::string lens_because;
  std::vector<ImageCalibration> images;  // those in use
  std::vector<CornerResidual> corners;   // in those images, outliers included
  // Over the corners in use; noise: per axis, over the degrees of freedom.
  double rms_px = 0, rms_2d_px = 0, noise_px = 0;
  double held_out_px = std::numeric_limits<double>::quiet_NaN();  // per axis
  double outlier_share = 0;
  // Bend in the middle of a grid, along x and y. 0: taken as flat, since the bend found is within three
  // sigma.
  Eigen::Vector2d board_bend_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d board_bend_sigma_m = Eigen::Vector2d::Zero();
  std::vector<CalibrationNote> notes;
  bool converged = false;
  std::string message;
  // Returns whether every gate passed.
  bool IsUsable() const;
};

// Calibrates the cameras of the input. Throws std::invalid_argument as CheckCalibrationInput does, and for
// options out of range.
Calibration CalibrateCameras(const CalibrationInput& input, const CalibrateCamerasOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_CALIBRATION_H_
