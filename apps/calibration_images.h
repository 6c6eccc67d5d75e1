// What the session's calibration images show, as the library takes it.
//
// Corners are found in the images (in parallel), or read from a corners.vnl; images of surveyed tags give the
// tags' corners, of the session's own photos one a view.
//
// Throws std::runtime_error naming the file that cannot be read, or differs in size from the camera's first.
#ifndef LUXFIT_APPS_CALIBRATION_IMAGES_H_
#define LUXFIT_APPS_CALIBRATION_IMAGES_H_

#include <string>
#include <vector>

#include "apps/session.h"
#include "calib/calibration_input.h"

namespace luxfit {

// Cameras that are calibrated together, and what from.
struct CalibrationGroup {
  std::vector<int> cameras;  // of the session
  bool is_rig = false;
  CalibrationInput input;             // images are named by their path as the session has it
  std::vector<std::string> messages;  // of images in which something was not found
};

// Whether the session says what the camera could be calibrated from.
bool CanBeCalibrated(const Session& session, const SessionCamera& camera);

// `cameras`: indices into the session's. Those of one board that pair up are one group.
std::vector<CalibrationGroup> ReadCalibrationImages(const Session& session, const std::vector<int>& cameras);

// The cameras of a rig, each for itself.
std::vector<CalibrationGroup> SplitRig(const CalibrationGroup& rig);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CALIBRATION_IMAGES_H_
