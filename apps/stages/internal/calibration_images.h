// What the session's calibration images show, as the library takes it.
//
// Corners are found in the images (in parallel), or read from a corners.vnl; images of surveyed tags give the
// tags' corners, of the session's own photos one a view.
//
// Throws std::runtime_error naming the file that cannot be read, or differs in size from the camera's first.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_CALIBRATION_IMAGES_H_
#define LUXFIT_APPS_STAGES_INTERNAL_CALIBRATION_IMAGES_H_

#include <string>
#include <vector>

#include "apps/session/session.h"
#include "calib/calibrate/calibration_input.h"
#include "calib/lens/camera.h"

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

// Whether the group's images show surveyed tags.
bool IsOfTags(const Session& session, const CalibrationGroup& group);

// Surveyed tags found again and their corners refined against the images, which takes the lens that a first
// calibration gave (calib/targets/tag_refine.h). 8-bit images stay as they are: their gamma moves edges.
CalibrationGroup WithRefinedTags(const Session& session, CalibrationGroup group, const Camera& lens);

// The cameras of a rig, each for itself.
std::vector<CalibrationGroup> SplitRig(const CalibrationGroup& rig);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_CALIBRATION_IMAGES_H_
