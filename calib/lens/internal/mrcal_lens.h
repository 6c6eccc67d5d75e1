// Converts a camera to libmrcal's form, a lens model and a vector of intrinsics, and back.
//
// libmrcal's header has no guard for C++: include it here only. libmrcal's functions abort the process on
// models that they do not know, so ToMrcal makes only models that they know.
//
// Throws std::invalid_argument for a fisheye lens, which mrcal does not have, and for a spline whose numbers
// do not agree.
#ifndef LUXFIT_CALIB_LENS_INTERNAL_MRCAL_LENS_H_
#define LUXFIT_CALIB_LENS_INTERNAL_MRCAL_LENS_H_

extern "C" {
#include <mrcal/mrcal.h>
}

#include <optional>
#include <vector>

#include "calib/lens/camera.h"

namespace luxfit {

struct MrcalLens {
  mrcal_lensmodel_t model;
  std::vector<double> intrinsics;  // fx fy cx cy, then the distortion coefficients or control points
};

// Returns the lens for libmrcal. kOpenCv becomes the shortest of mrcal's OPENCV4, 5, 8, 12 that holds all
// coefficients other than 0, at least `min_coefficients` of them.
MrcalLens ToMrcal(const Camera& camera, int min_coefficients = 4);

// Returns the pixel of a point and its derivative; nothing where libmrcal has none. Writes d pixel / d
// intrinsics, 2 rows, to `d_intrinsics` unless that is null.
std::optional<Projection> ProjectByMrcal(const mrcal_lensmodel_t& model, const double* intrinsics,
                                         const Eigen::Vector3d& p_in_cam, double* d_intrinsics);

// Returns the camera of a libmrcal lens; `size` gives only width and height. Throws std::invalid_argument for
// models that Camera does not have (CAHVOR, CAHVORE, LONLAT, LATLON).
Camera FromMrcal(const MrcalLens& lens, const Camera& size);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_INTERNAL_MRCAL_LENS_H_
