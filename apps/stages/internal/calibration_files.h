// A calibration as files: JSON, intrinsics in the formats of other programs, tables and pictures.
//
// Cameras that failed a gate are marked: "usable": false, and a comment with the reason in every file of
// intrinsics. A camera's files are named by its id, characters that a file's name should not hold replaced by
// "_".
#ifndef LUXFIT_APPS_STAGES_INTERNAL_CALIBRATION_FILES_H_
#define LUXFIT_APPS_STAGES_INTERNAL_CALIBRATION_FILES_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/stages/internal/calibration_images.h"
#include "calib/calibrate/calibration.h"

namespace luxfit {

struct CalibratedGroup {
  CalibrationGroup group;
  Calibration calibration;
};

// Of the artifact: {"cameras": [...], lens, residuals, images, ...}.
nlohmann::json GroupJson(const CalibratedGroup& calibrated);

// Writes into the folder; returns the names of the files.
std::vector<std::string> WriteCalibrationFiles(const std::vector<CalibratedGroup>& groups,
                                               const std::string& folder);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_CALIBRATION_FILES_H_
