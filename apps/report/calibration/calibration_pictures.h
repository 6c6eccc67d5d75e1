// Makes the pictures of the page of a calibration: residuals, coverage, uncertainty and the rig, one section
// each.
#ifndef LUXFIT_APPS_REPORT_CALIBRATION_CALIBRATION_PICTURES_H_
#define LUXFIT_APPS_REPORT_CALIBRATION_CALIBRATION_PICTURES_H_

#include <string>

#include "apps/report/calibration/calibration_record.h"

namespace luxfit {

// Reprojection errors of each camera as vectors over its image and as a histogram.
std::string ResidualSection(const CalibrationRecord& record);

// Where corners fell in each image, with the gaps named.
std::string CoverageSection(const CalibrationRecord& record);

// Sigma of projections over each image, for directions and at the usual distance of the target.
std::string UncertaintySection(const CalibrationRecord& record);

// Cameras, fields of view and boards from above and from the side.
std::string RigSection(const CalibrationRecord& record);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_CALIBRATION_CALIBRATION_PICTURES_H_
