// Reads what `luxfit calibrate` left in its folder: OUT/stages/calibrate.json and OUT/corner_residuals.csv.
//
// docs/schema/calibrate.schema.json describes the first. The second has the corners of the images in the
// order in which the first has the images. What is not determined is NaN.
//
// Throws std::runtime_error naming the file that is missing, has another format, or is of an earlier version.
#ifndef LUXFIT_APPS_REPORT_CALIBRATION_CALIBRATION_RECORD_H_
#define LUXFIT_APPS_REPORT_CALIBRATION_CALIBRATION_RECORD_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/charts/residual_svg.h"
#include "calib/calibrate/image_circle.h"

namespace luxfit {

struct RecordedMap {
  double range_m = 0;  // infinity: directions
  Eigen::MatrixXd sigma_px;
};

struct RecordedCamera {
  std::string id;
  int width_px = 0, height_px = 0;
  // Focal lengths and principal point, px, then coefficients of distortion.
  std::vector<std::string> parameter_names;
  Eigen::VectorXd parameters, parameter_sigmas;
  Eigen::Isometry3d cam_from_rig = Eigen::Isometry3d::Identity();
  Eigen::Vector3d rotation_sigma_rad, translation_sigma_m;
  double baseline_m = 0, baseline_sigma_m = 0, rotation_deg = 0, rotation_sigma_deg = 0;
  std::array<Eigen::Vector3d, 4> corner_directions;
  ImageCircle circle;
  double middle_sigma_px = 0, median_sigma_px = 0, uncertain_share = 0;
  std::vector<RecordedMap> maps;
  Eigen::MatrixXi corner_counts;
  double covered_share = 0, nearest_m = 0, farthest_m = 0;
  double max_tilt_deg = 0;  // NaN: the target is not flat
  std::vector<std::string> lacks;
  std::vector<SeenCorner> corners;
};

struct RecordedImage {
  std::string file, camera;
  int set = 0, corners = 0, outliers = 0;
  double rms_px = 0;
  Eigen::Isometry3d cam_from_target = Eigen::Isometry3d::Identity();
};

struct LeftOutImage {
  std::string file, camera, reason;
};

struct RecordedGroup {
  bool is_usable = false, is_rig = false;
  std::string board;  // empty: the room's surveyed tags
  Eigen::AlignedBox3d target;
  std::string lens, lens_because;  // empty: nothing converged
  double rms_px = 0, rms_2d_px = 0, noise_px = 0, held_out_px = 0, outlier_share = 0;
  std::vector<RecordedCamera> cameras;
  std::vector<RecordedImage> images;
  std::vector<LeftOutImage> left_out;
};

struct CalibrationRecord {
  std::string out;                                 // absolute path of the folder
  std::shared_ptr<const nlohmann::json> artifact;  // stages/calibrate.json
  std::vector<RecordedGroup> groups;
};

// Returns the path of the file that a calibration leaves in its folder.
std::string CalibrationFileOf(const std::string& out);

CalibrationRecord ReadCalibrationRecord(const std::string& out);

// Returns the group's cameras by name: "left, right".
std::string CameraNames(const RecordedGroup& group);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_CALIBRATION_CALIBRATION_RECORD_H_
