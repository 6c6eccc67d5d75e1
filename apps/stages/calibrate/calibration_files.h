// Writes a calibration to files: intrinsics in the formats of other programs, tables and pictures.
//
// Cameras that failed a gate are marked with a comment that gives the reason in every file of intrinsics. A camera's files are named by its id; characters that do not suit a file name
// become "_".
#ifndef LUXFIT_APPS_STAGES_CALIBRATE_CALIBRATION_FILES_H_
#define LUXFIT_APPS_STAGES_CALIBRATE_CALIBRATION_FILES_H_

#include <string>
#include <vector>

#include "apps/stages/calibrate/calibrated_group.h"

namespace luxfit {

// Writes into the folder and returns the names of the files.
std::vector<std::string> WriteCalibrationFiles(const std::vector<CalibratedGroup>& groups,
                                               const std::string& folder);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CALIBRATE_CALIBRATION_FILES_H_
