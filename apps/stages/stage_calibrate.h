// The stage before registration: cameras without intrinsics calibrated from their images.
//
// Cameras of one board whose images pair up (apps/stages/internal/calibration_sets.h) are calibrated as a rig; a rig that
// the images do not bear out is given up for its cameras one by one, with a warning. A camera with neither
// intrinsics nor calibration images is calibrated from its own photos of the surveyed tags.
//
// Writes OUT/stages/calibrate.json, and for every camera ID OUT/ID.yaml (OpenCV), OUT/ID.cameramodel (mrcal),
// OUT/ID_uncertainty.svg, for all OUT/cameras.txt (COLMAP), OUT/camchain.yaml (Kalibr), OUT/corners.vnl and
// OUT/corner_residuals.csv; formats that cannot hold the lens are left out. What fails a gate is a warning,
// sets context.undetermined, and is marked in the files.
//
// Throws std::runtime_error for images that cannot be read, or differ in size.
#ifndef LUXFIT_APPS_STAGES_STAGE_CALIBRATE_H_
#define LUXFIT_APPS_STAGES_STAGE_CALIBRATE_H_

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "apps/stages/stages.h"

namespace luxfit {

// The artifact, from all cameras of the session that have something to be calibrated from.
nlohmann::json CalibrateSession(const Session& session, RunContext& context);

// Every camera of the session: from its file of intrinsics, or calibrated. Throws std::runtime_error where a
// camera's images determine nothing.
std::vector<Camera> CamerasOf(const Session& session, RunContext& context);

// Of the artifact, for the terminal.
std::string CalibrationTable(const nlohmann::json& artifact);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_STAGE_CALIBRATE_H_
