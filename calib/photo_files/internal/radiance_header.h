// Reads the header of a Radiance picture (.hdr, .pic).
//
//   radiance = stored value / multiplier
//
// The multiplier is the product of all EXPOSURE lines, and of COLORCORR by channel: programs that scale a
// picture record the factor there. OpenCV reads the pixels and ignores both.
//
// Throws std::runtime_error, naming the file, for pixels in CIE XYZ, which are not a camera's red, green and
// blue, and for a multiplier that is not > 0.
// Source: Radiance, "File Formats", section "Picture files".
#ifndef LUXFIT_CALIB_PHOTO_FILES_INTERNAL_RADIANCE_HEADER_H_
#define LUXFIT_CALIB_PHOTO_FILES_INTERNAL_RADIANCE_HEADER_H_

#include <array>
#include <optional>
#include <string>

namespace luxfit {

struct RadianceHeader {
  std::array<double, 3> multiplier{1, 1, 1};  // red, green, blue
};

// Returns the header; empty where the file is no Radiance picture.
std::optional<RadianceHeader> ReadRadianceHeader(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_PHOTO_FILES_INTERNAL_RADIANCE_HEADER_H_
