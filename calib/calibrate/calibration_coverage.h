// Where a camera's calibration images hold corners, and what they lack, in words.
//
// Lens parameters are known where corners were: the image is cut into 6 x 6 cells. The focal length is known
// from foreshortening, so a flat board has to be tilted; boards at one distance only leave it to the tilt
// alone.
#ifndef LUXFIT_CALIB_CALIBRATE_CALIBRATION_COVERAGE_H_
#define LUXFIT_CALIB_CALIBRATE_CALIBRATION_COVERAGE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "calib/calibrate/calibration_input.h"

namespace luxfit {

struct CalibrationCoverage {
  Eigen::MatrixXi corner_counts;  // 6 x 6 cells, rows from the top
  double covered_share = 0;       // of cells with a corner
  int images = 0;
  // Of a flat target: its normal against the optical axis; 0 of a room's tags, which do not lie in a plane.
  double max_tilt_deg = 0;
  bool is_flat = true;
  double nearest_m = 0, farthest_m = 0;  // of the targets' seen corners' middle
  std::vector<std::string> lacks;        // sentences: what to photograph besides
};

// One image of the camera that is in use: corners seen, and where the target was.
struct CoveringImage {
  std::vector<BoardCorner> corners;
  Eigen::Isometry3d cam_from_target;
};

// Marked ninths of an image in words: "the left third and the upper middle third"; whole rows and columns are
// named as such. Empty where none is marked.
std::string ThirdsInWords(const Eigen::Array<bool, 3, 3>& marked);

CalibrationCoverage CoverageOf(const CalibrationTarget& target, const CalibrationCamera& camera,
                               const std::vector<CoveringImage>& images);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_CALIBRATION_COVERAGE_H_
