// Calibration: lenses of cameras, and how the cameras of a rig stand to each other, from images of a board or
// of surveyed tags.
//
//   min over lens_c, cam_from_rig_c, rig_from_target_s, bend of
//     sum_corners w^2 |f(lens_c, cam_from_rig_c rig_from_target_s p) - q|^2
// by libmrcal (its weak regularisation of distortion included), or OpenCV; w is the median corner's sigma
// over the corner's own. Nothing has to be known beforehand: focal lengths are scanned, wrong corners left
// out (more than `outlier_sigmas` off) and named.
//
// The lens is the simplest candidate that images held out support: k folds over sets; each left-out set is
// placed by its own corners (6 of its residuals' freedom) with the lens of the others, and
//   held-out^2 = sum |r|^2 / sum (2 n - 6)   per axis, over sets
// A simpler lens will do if its held-out^2 exceeds the best one's by no more than the larger of one standard
// error of that difference over sets and the square of the best lens' own projection uncertainty at the
// corners.
//
// (weighted as above, so of the median corner; it compares with the noise, not with the plain rms.)
//
// A small residual alone proves nothing (boards in the middle of the image fit any lens): held-out error,
// uncertainty of projections and coverage have gates, and what fails them is a note that says so, with the
// remedy; the cameras are then not usable, though returned.
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

#include "calib/calibrate/calibration_coverage.h"
#include "calib/calibrate/calibration_input.h"
#include "calib/lens/camera.h"
#include "calib/lens/lens_kind.h"
#include "calib/lens/projection_uncertainty.h"

namespace luxfit {

enum class CalibrationBackEnd { kMrcal, kOpenCv };

struct CalibrationGates {
  double max_held_out_px = 1.0;       // per axis: sharp corners and a fitting lens stay well below
  double max_held_out_ratio = 1.5;    // to the noise of the fit: more is a lens with too many parameters
  double max_sigma_px = 1.0;          // of a direction's projection ...
  double max_uncertain_share = 0.2;   // ... over more than this part of the image
  double min_covered_share = 0.5;     // of the cells of the image (calib/calibrate/calibration_coverage.h)
  double min_tilt_deg = 10;           // of a flat board, once at least: the focal length needs it
  double questioned_outliers = 0.03;  // share of corners; more is a warning
  double max_outliers = 0.2;          // and more than this a failure
};

struct CalibrateCamerasOptions {
  // Candidates in order of complexity; empty: OPENCV4, 5, 8, 12 and two splined lenses (FISHEYE too where the
  // field of view is wide). A single one is taken as it is.
  std::vector<LensKind> lenses;
  CalibrationBackEnd back_end = CalibrationBackEnd::kMrcal;
  int folds = 5;  // of sets held out; fewer where there are fewer sets
  double outlier_sigmas = 4;
  double focal_start_px = 0;  // 0: scanned; else only focal lengths within a factor of 2 are tried
  bool board_may_bend = true;
  CalibrationGates gates;
};

struct CalibrationNote {
  std::string code;    // held_out_error, uncertain_projection, few_images, outliers, image_rejected, ...
  bool fails = false;  // a gate: the cameras are not usable
  std::string message, remedy;
};

struct CalibratedCamera {
  std::string id;
  Camera camera;
  Eigen::Isometry3d cam_from_rig = Eigen::Isometry3d::Identity();  // the first camera is the rig's frame
  // Rotation vector (rad) and translation (m) in the camera's axes; zero of the first camera.
  Eigen::Matrix<double, 6, 1> cam_from_rig_sigma = Eigen::Matrix<double, 6, 1>::Zero();
  ProjectionCovariance uncertainty;
  CalibrationCoverage coverage;
  double uncertain_share = 1;    // of the image, with sigma of a direction above the gate
  double median_sigma_px = 0;    // of a direction, over the image
  std::string uncertain_places;  // ninths of the image with such a place, in words
};

struct ImageCalibration {
  int image = 0;  // of the input
  int corners = 0, outliers = 0;
  double rms_px = 0;  // per axis, of the corners in use
  Eigen::Isometry3d cam_from_target = Eigen::Isometry3d::Identity();
};

struct CornerResidual {
  int image = 0, index = 0;  // of the input; of the target
  Eigen::Vector2d residual_px;
  bool is_outlier = false;
};

struct LensScore {
  LensKind kind;
  bool is_fitted = false;
  // Per axis; held out: NaN where there were too few sets, infinity where the lens has no image of a corner.
  double rms_px = 0, held_out_px = 0;
  int outliers = 0;
  std::string verdict;
};

struct Calibration {
  std::vector<CalibratedCamera> cameras;
  LensKind lens;
  std::vector<LensScore> lenses;  // every candidate tried, in order
  std::string lens_because;
  std::vector<ImageCalibration> images;            // those in use
  std::vector<CornerResidual> corners;             // of those images, outliers too
  double rms_px = 0, rms_2d_px = 0, noise_px = 0;  // of corners in use; noise: per axis, freedom taken off
  double held_out_px = std::numeric_limits<double>::quiet_NaN();  // per axis
  double outlier_share = 0;
  // In the middle of a grid, along x and y; 0: flat, as no more than three sigma of bend was found.
  Eigen::Vector2d board_bend_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d board_bend_sigma_m = Eigen::Vector2d::Zero();
  std::vector<CalibrationNote> notes;
  bool converged = false;
  std::string message;
  // Every gate passed.
  bool IsUsable() const;
};

// Throws std::invalid_argument as CheckCalibrationInput does, and for options out of range.
Calibration CalibrateCameras(const CalibrationInput& input, const CalibrateCamerasOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_CALIBRATION_H_
