// Reports where a camera's calibration images hold corners, and names in words what they lack.
//
// Lens parameters are determined only where corners were seen: the image is divided into 6 x 6 cells. Cells whose middle
// lies outside the image circle count where they hold a corner, and are not lacking where they hold none. The
// focal length is determined by foreshortening, so a flat board has to be tilted. Boards at one distance
// leave it to the tilt alone.
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_COVERAGE_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_COVERAGE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "calib/calibrate/calibration.h"

namespace luxfit {

// Holds one image in use of the camera: the corners seen, and the pose of the target.
struct CoveringImage {
  std::vector<BoardCorner> corners;
  Eigen::Isometry3d cam_from_target;
};

// Returns the marked ninths of an image in words: "the left third and the upper middle third". Whole rows and
// columns are named as such. Empty where no ninth is marked.
std::string ThirdsInWords(const Eigen::Array<bool, 3, 3>& marked);

// Returns the coverage of one camera by its images.
CalibrationCoverage CoverageOf(const CalibrationTarget& target, const CalibrationCamera& camera,
                               const ImageCircle& circle, const std::vector<CoveringImage>& images);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_COVERAGE_H_
