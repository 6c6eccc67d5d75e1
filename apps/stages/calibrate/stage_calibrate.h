// Calibrates cameras without intrinsics from their images; this stage precedes registration.
//
// Cameras of one board whose images pair up (apps/stages/calibrate/calibration_sets.h) are calibrated as a
// rig. Where the images contradict the rig, its cameras are calibrated one by one, with a warning. A camera
// with neither intrinsics nor calibration images is calibrated from its own photos of the surveyed tags.
//
// Writes OUT/stages/calibrate.json and for every camera ID OUT/ID.yaml (OpenCV), OUT/ID.cameramodel (mrcal)
// and OUT/ID_uncertainty.svg. For all cameras it writes OUT/cameras.txt (COLMAP), OUT/camchain.yaml (Kalibr),
// OUT/corners.vnl and OUT/corner_residuals.csv. Formats that cannot hold the lens are left out. A failed gate
// gives a warning that leaves the result undetermined, and is marked in the files.
//
// Throws std::runtime_error for images that cannot be read, or differ in size.
#ifndef LUXFIT_APPS_STAGES_CALIBRATE_STAGE_CALIBRATE_H_
#define LUXFIT_APPS_STAGES_CALIBRATE_STAGE_CALIBRATE_H_

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "apps/stages/stages.h"

namespace luxfit {

// Returns the artifact, from all cameras of the session that can be calibrated.
nlohmann::json CalibrateSession(const Session& session, RunContext& context);

// Returns every camera of the session: from its file of intrinsics, or calibrated. `photos` serve where it
// has neither intrinsics nor calibration images. Throws std::runtime_error where a camera's images determine
// nothing.
std::vector<Camera> CamerasOf(const Session& session, const LinearizedPhotos& photos, RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CALIBRATE_STAGE_CALIBRATE_H_
