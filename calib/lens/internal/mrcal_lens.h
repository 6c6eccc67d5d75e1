// A camera as libmrcal wants it: its lens model and its vector of intrinsics.
//
// libmrcal's header has no guard for C++ and must only be included here. Its functions abort the process on
// models that they do not know: ToMrcal makes only such as they do.
//
// Throws std::invalid_argument for a fisheye lens (mrcal has none of that kind) and a spline whose numbers do
// not fit each other.
#ifndef LUXFIT_CALIB_LENS_INTERNAL_MRCAL_LENS_H_
#define LUXFIT_CALIB_LENS_INTERNAL_MRCAL_LENS_H_

extern "C" {
#include <mrcal/mrcal.h>
}

#include <vector>

#include "calib/lens/camera.h"

namespace luxfit {

struct MrcalLens {
  mrcal_lensmodel_t model;
  std::vector<double> intrinsics;  // fx fy cx cy, then the distortion coefficients or control points
};

// kOpenCv becomes the shortest of OPENCV4, 5, 8, 12 that holds all coefficients that are not 0, at least
// `min_coefficients` of them.
MrcalLens ToMrcal(const Camera& camera, int min_coefficients = 4);

// The inverse; `size` gives width and height only. Throws std::invalid_argument for models that Camera does
// not have (CAHVOR, CAHVORE, LONLAT, LATLON).
Camera FromMrcal(const MrcalLens& lens, const Camera& size);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_INTERNAL_MRCAL_LENS_H_
