// Makes the report of a calibration: OUT/report.html, one file that opens from disk without a network and
// runs no script.
//
// docs/calibrate-a-rig.md explains each part.
#ifndef LUXFIT_APPS_REPORT_CALIBRATION_CALIBRATION_REPORT_H_
#define LUXFIT_APPS_REPORT_CALIBRATION_CALIBRATION_REPORT_H_

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/report/calibration/calibration_record.h"

namespace luxfit {

// Returns the page as HTML.
std::string CalibrationPage(const CalibrationRecord& record, const std::string& command_line);

// Returns what the page says in figures: docs/schema/calibration_report.schema.json, without the page's path.
nlohmann::json CalibrationSummary(const CalibrationRecord& record);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_CALIBRATION_CALIBRATION_REPORT_H_
