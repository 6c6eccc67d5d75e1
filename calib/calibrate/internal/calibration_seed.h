// Makes a first guess of all unknowns from the corners alone, so that no focal length has to be given.
//
// The seed tries focal lengths of a pinhole and of a plain stereographic lens, with the lens' centre at the
// image's. They range from 0.2 to 8 image widths for the pinhole, from 0.12 to 1.5 for the other. For each
// focal length the seed finds the target's pose in every image separately. The lens with the smallest errors
// in all of a camera's images is chosen. The cameras of a rig are then joined by the pair of images that most
// other pairs agree with.
//
// Returns `ok` false and names what cannot be placed: a camera without a usable image, cameras without a set
// in common. Images whose corners fit no pose are marked in `image_found`.
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_SEED_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_SEED_H_

#include <string>
#include <vector>

#include "calib/calibrate/internal/calibration_state.h"

namespace luxfit {

struct CalibrationSeed {
  bool ok = false;
  std::string message, remedy;    // say why the seed failed
  CalibrationState pinhole;       // opencv4 without distortion
  CalibrationState wide;          // splined0
  bool is_wide = false;           // true where `wide` fits better
  std::vector<bool> image_found;  // by image of the input: false where no pose fits its corners
};

// Returns the seed. `focal_start_px` > 0: only focal lengths within a factor of 2 of it are tried.
CalibrationSeed SeedCalibration(const CalibrationProblem& problem, double focal_start_px);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_SEED_H_
