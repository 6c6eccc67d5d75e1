// A first guess of everything, from the corners alone: nobody has to know a focal length.
//
// Focal lengths from 0.2 to 8 image widths are tried, of a pinhole and of a plain stereographic lens, with
// the centre of the image as the lens' centre. At each the target's pose in every image is found by itself;
// the lens that leaves the smallest errors in all of a camera's images wins. Cameras of a rig are then joined
// by the pair of images that most other pairs agree with.
//
// What cannot be placed is named: images whose corners fit no pose, cameras without a set in common.
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_SEED_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_SEED_H_

#include <string>
#include <vector>

#include "calib/calibrate/internal/calibration_state.h"

namespace luxfit {

struct CalibrationSeed {
  bool ok = false;
  std::string message, remedy;    // why not
  CalibrationState pinhole;       // OPENCV4 without distortion
  CalibrationState wide;          // SPLINED0
  bool is_wide = false;           // which of the two fits better
  std::vector<bool> image_found;  // by image of the input: false where no pose fits its corners
};

// `focal_start_px` > 0: only focal lengths within a factor of 2 of it are tried.
CalibrationSeed SeedCalibration(const CalibrationProblem& problem, double focal_start_px);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_SEED_H_
