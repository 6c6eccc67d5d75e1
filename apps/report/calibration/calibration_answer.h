// Makes the first part of the page of a calibration: whether it can be used, and what was found.
//
// Every value has one sigma behind ±. It holds the noise of the corners, and not an error of the board.
#ifndef LUXFIT_APPS_REPORT_CALIBRATION_CALIBRATION_ANSWER_H_
#define LUXFIT_APPS_REPORT_CALIBRATION_CALIBRATION_ANSWER_H_

#include <string>

#include "apps/report/calibration/calibration_record.h"

namespace luxfit {

// Says in one sentence whether the calibration can be used, and why not.
std::string Verdict(const CalibrationRecord& record);

// Returns the section with the verdict, lenses, rig and findings.
std::string AnswerSection(const CalibrationRecord& record);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_CALIBRATION_CALIBRATION_ANSWER_H_
