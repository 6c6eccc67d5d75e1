// Holds cameras that were calibrated together: what went in, and what came out.
#ifndef LUXFIT_APPS_STAGES_CALIBRATE_CALIBRATED_GROUP_H_
#define LUXFIT_APPS_STAGES_CALIBRATE_CALIBRATED_GROUP_H_

#include "apps/stages/calibrate/calibration_images.h"
#include "calib/calibrate/calibration.h"

namespace luxfit {

struct CalibratedGroup {
  CalibrationGroup group;
  Calibration calibration;
};

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CALIBRATE_CALIBRATED_GROUP_H_
