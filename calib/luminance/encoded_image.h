// Pictures to look at, as the bytes of a file.
//
//   level = 255 s(value / white),  s the transfer curve of sRGB
//
// Rows from the top, red, green, blue of each pixel. Throws std::invalid_argument where the sizes do not fit,
// std::runtime_error where the picture cannot be encoded.
// Source: IEC 61966-2-1 (sRGB).
#ifndef LUXFIT_CALIB_LUMINANCE_ENCODED_IMAGE_H_
#define LUXFIT_CALIB_LUMINANCE_ENCODED_IMAGE_H_

#include <array>
#include <cstdint>
#include <vector>

#include "calib/luminance/image.h"

namespace luxfit {

struct DisplayPicture {
  int width_px = 0, height_px = 0;
  std::vector<uint8_t> rgb;
};

// Linear planes, `white` shown as 255; what is not finite is white.
DisplayPicture ToDisplay(const std::array<ImagePlane, 3>& linear_rgb, double white);

// Means of whole pixels that make `width_px` columns, the height to match; the plane itself where it has no
// more.
ImagePlane Reduced(const ImagePlane& plane, int width_px);

std::vector<uint8_t> EncodeJpeg(const DisplayPicture& picture, int quality = 85);
std::vector<uint8_t> EncodePng(const DisplayPicture& picture);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_ENCODED_IMAGE_H_
