// Collects what the session's calibration images show, in the form that the library takes.
//
// Corners are found in the images (in parallel), or read from a corners.vnl. Images of surveyed tags give the
// tags' corners; the session's own photos count once for each view.
//
// Throws std::runtime_error naming the file that cannot be read, or that differs in size from the camera's
// first.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_CALIBRATION_IMAGES_H_
#define LUXFIT_APPS_STAGES_INTERNAL_CALIBRATION_IMAGES_H_

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/session/session.h"
#include "calib/calibrate/calibration_input.h"
#include "calib/lens/camera.h"
#include "calib/photo_files/image.h"

namespace luxfit {

// Holds cameras that are calibrated together, and their images.
struct CalibrationGroup {
  std::vector<int> cameras;  // indices into the session's
  bool is_rig = false;
  std::string pairing = "none";  // the rule by which images of several cameras form sets (calibration_sets.h)
  CalibrationInput input;        // images are named by their path as the session has it
  std::optional<Board> board;    // what the images show; nothing: the room's surveyed tags
  std::map<int, std::string> messages;  // by image that shows less than half of the target
};

// Holds the file of the first photo by camera (index into the session's) and view. The others show the same
// tags from the same place.
using OwnPhotos = std::map<std::pair<int, std::string>, std::string>;

// Returns the weighted sum of the photo's channels, as boards and tags are searched for in.
ImagePlane GreyOf(const Photo& photo, const Eigen::Vector3d& weights);

// Tells whether the session has something from which the camera can be calibrated.
bool CanBeCalibrated(const Session& session, const SessionCamera& camera);

// `cameras` are indices into the session's. Cameras of one board whose images pair up form one group.
std::vector<CalibrationGroup> ReadCalibrationImages(const Session& session, const OwnPhotos& photos,
                                                    const std::vector<int>& cameras);

// Tells whether the group's images show surveyed tags.
bool IsOfTags(const Session& session, const CalibrationGroup& group);

// Finds surveyed tags again and refines their corners against the images. This takes the lens that a first
// calibration gave (calib/targets/tags.h). 8-bit images stay as they are, because their gamma moves
// edges.
CalibrationGroup WithRefinedTags(const Session& session, CalibrationGroup group, const Camera& lens);

// Returns the cameras of a rig as separate groups.
std::vector<CalibrationGroup> SplitRig(const CalibrationGroup& rig);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_CALIBRATION_IMAGES_H_
