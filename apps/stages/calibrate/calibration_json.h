// Returns a calibration as JSON: the entries of `groups` in OUT/stages/calibrate.json.
//
// Everything that the page of a calibration draws stands here or in OUT/corner_residuals.csv: poses, the
// uncertainty of projections over the image, what the images cover, and which images were left out and why.
// docs/schema/calibrate.schema.json describes every key.
#ifndef LUXFIT_APPS_STAGES_CALIBRATE_CALIBRATION_JSON_H_
#define LUXFIT_APPS_STAGES_CALIBRATE_CALIBRATION_JSON_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/stages/calibrate/calibrated_group.h"

namespace luxfit {

nlohmann::json GroupJson(const CalibratedGroup& calibrated);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CALIBRATE_CALIBRATION_JSON_H_
