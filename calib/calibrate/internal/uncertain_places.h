// Finds where in its image a calibrated camera is uncertain: cells of a raster of 24 x 18 within its image circle.
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_UNCERTAIN_PLACES_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_UNCERTAIN_PLACES_H_

#include "calib/calibrate/calibration.h"

namespace luxfit {

// Sets the share of the circle where the sigma of a direction exceeds the limit, the sigma's median and the places in
// words. A sigma that is not determined counts as above the limit.
void WriteUncertainPlaces(double limit_px, CalibratedCamera& camera);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_UNCERTAIN_PLACES_H_
