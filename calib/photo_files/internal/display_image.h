// Converts linear counts to 8-bit grey levels for detectors that need them.
//
//   level = 255 (value / white)^(1 / gamma),   white: the brightest value except the luminaires in view
#ifndef LUXFIT_CALIB_PHOTO_FILES_INTERNAL_DISPLAY_IMAGE_H_
#define LUXFIT_CALIB_PHOTO_FILES_INTERNAL_DISPLAY_IMAGE_H_

#include <cstdint>
#include <vector>

#include "calib/photo_files/image.h"

namespace luxfit {

// Returns the levels row by row, as many as the plane has pixels; NaN is white.
std::vector<uint8_t> DisplayImage(const ImagePlane& grey, double gamma);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_PHOTO_FILES_INTERNAL_DISPLAY_IMAGE_H_
