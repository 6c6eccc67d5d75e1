// Formats OUT/stages/calibrate.json for the terminal.
#ifndef LUXFIT_APPS_STAGES_CALIBRATE_CALIBRATION_TABLE_H_
#define LUXFIT_APPS_STAGES_CALIBRATE_CALIBRATION_TABLE_H_

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace luxfit {

std::string CalibrationTable(const nlohmann::json& artifact);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CALIBRATE_CALIBRATION_TABLE_H_
