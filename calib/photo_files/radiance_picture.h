// Writes a Radiance picture (.hdr): red, green and blue of every pixel with one exponent (RGBE).
//
//   L = 179 (0.265 R + 0.670 G + 0.065 B)                                    cd/m2
//
// R, G, B are spectral radiances of Radiance, W/(sr m2), where the caller's planes are. A channel holds 8 bits of
// the largest of the three: it is within 1 / 128 of that. Values below 0 and NaN are written as 0. Scanlines are
// run-length encoded where they have 8 to 32767 pixels, from the top row down.
//
// Throws std::invalid_argument for planes that are empty or differ in size, and for header lines that hold a line
// break; std::runtime_error, naming the file, where it cannot be written.
// Source: Radiance, "File Formats", section "Picture files"; Ward (1991), "Real pixels", Graphics Gems II.
#ifndef LUXFIT_CALIB_PHOTO_FILES_RADIANCE_PICTURE_H_
#define LUXFIT_CALIB_PHOTO_FILES_RADIANCE_PICTURE_H_

#include <array>
#include <string>
#include <vector>

#include "calib/photo_files/image.h"

namespace luxfit {

// cd/m2 per W/(sr m2) of Radiance.
inline constexpr double kRadianceEfficacy = 179;

// Returns 0.265 R + 0.670 G + 0.065 B.
ImagePlane RadianceBrightness(const std::array<ImagePlane, 3>& rgb);

// Writes the file whole or not at all. `header` are lines beside FORMAT, such as "VIEW= -vtv -vh 40 -vv 30".
void WriteRadiancePicture(const std::string& path, const std::array<ImagePlane, 3>& rgb,
                          const std::vector<std::string>& header);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_PHOTO_FILES_RADIANCE_PICTURE_H_
