// Makes the row of each family of lenses (calib/lens/lens_family.h), each in a file of its own.
#ifndef LUXFIT_CALIB_LENS_INTERNAL_LENS_H_
#define LUXFIT_CALIB_LENS_INTERNAL_LENS_H_

#include <limits>

#include "calib/lens/lens_family.h"

namespace luxfit {

// Coordinates of a point that has no image.
inline constexpr double kNoImage = std::numeric_limits<double>::quiet_NaN();

LensOps OpenCvLens();
LensOps FisheyeLens();
LensOps SplinedLens();  // by libmrcal

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_INTERNAL_LENS_H_
