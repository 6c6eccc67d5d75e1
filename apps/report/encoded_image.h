// Encodes pictures for display as the bytes of a file.
//
//   level = 255 s(value / white),  s: the transfer curve of sRGB
//
// Rows from the top; red, green, blue of each pixel. Throws std::invalid_argument where the sizes do not
// agree, std::runtime_error where the picture cannot be encoded.
// Source: IEC 61966-2-1 (sRGB).
#ifndef LUXFIT_APPS_REPORT_ENCODED_IMAGE_H_
#define LUXFIT_APPS_REPORT_ENCODED_IMAGE_H_

#include <array>
#include <cstdint>
#include <vector>

#include "calib/photo_files/image.h"

namespace luxfit {

struct DisplayPicture {
  int width_px = 0, height_px = 0;
  std::vector<uint8_t> rgb;
};

// Returns linear planes for display, `white` shown as 255. Values that are not finite are shown as 255.
DisplayPicture ToDisplay(const std::array<ImagePlane, 3>& linear_rgb, double white);

// Returns the plane reduced to `width_px` columns, the height to match, by means over pixels. Returns the
// plane itself where it has no more columns. Throws std::invalid_argument where width_px < 1.
ImagePlane Reduced(const ImagePlane& plane, int width_px);

std::vector<uint8_t> EncodeJpeg(const DisplayPicture& picture);
std::vector<uint8_t> EncodePng(const DisplayPicture& picture);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_ENCODED_IMAGE_H_
