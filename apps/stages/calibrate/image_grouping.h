// Says how images were taken for those of cameras, and which of them for taken together, in the form of choices.
//
//   photos of left         13               in left
//   sets of left, right    13, by numbers   left01.jpg with right01.jpg and so on
#ifndef LUXFIT_APPS_STAGES_CALIBRATE_IMAGE_GROUPING_H_
#define LUXFIT_APPS_STAGES_CALIBRATE_IMAGE_GROUPING_H_

#include <vector>

#include "apps/stages/calibrate/calibration_images.h"
#include "apps/stages/stages.h"

namespace luxfit {

std::vector<Choice> GroupingChoices(const CalibrationGroup& group);

// Tells whether a choice is one of these.
bool IsGroupingChoice(const std::string& what);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CALIBRATE_IMAGE_GROUPING_H_
