// The header of a Radiance picture (.hdr, .pic).
//
//   radiance = stored value / multiplier
//
// with the product of all EXPOSURE lines, and COLORCORR by channel: programs that scale a picture write down
// by what. OpenCV reads the pixels and passes both over.
//
// Throws std::runtime_error naming the file for pixels in CIE XYZ, which are no camera's red, green and blue,
// and for a multiplier that is not > 0.
// Source: Radiance, "File Formats", section "Picture files".
#ifndef LUXFIT_CALIB_LUMINANCE_INTERNAL_RADIANCE_HEADER_H_
#define LUXFIT_CALIB_LUMINANCE_INTERNAL_RADIANCE_HEADER_H_

#include <array>
#include <optional>
#include <string>

namespace luxfit {

struct RadianceHeader {
  std::array<double, 3> multiplier{1, 1, 1};  // red, green, blue
};

// Empty where the file is no Radiance picture.
std::optional<RadianceHeader> ReadRadianceHeader(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_INTERNAL_RADIANCE_HEADER_H_
