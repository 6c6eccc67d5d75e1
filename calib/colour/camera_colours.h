// Tells what a camera's red, green and blue are in CIE XYZ.
//
//   XYZ = M rgb     rgb: counts that are proportional to light; Y is their luminance, up to one factor
//
// - RAW: the inverse of the matrix that LibRaw has for the sensor: the file's own ColorMatrix for daylight (DNG), else LibRaw's
//   for the model. Counts are not balanced for white, and M says what they are as they stand.
// - JPEG, HEIC, PNG and TIFF: the primaries of the file's colour profile, as they are before the profile adapts them to D50; without
//   a profile those of sRGB. A camera balances such photos for white, which no file tells.
//
// A sensor does not see as CIE's observer does: M holds on average over usual surfaces and lights.
// Sources: DNG 1.6, "Mapping Camera Color Space to CIE XYZ Space"; IEC 61966-2-1 (sRGB); ICC.1:2010, 9.2.15 (chad); LibRaw 0.20.
#ifndef LUXFIT_CALIB_COLOUR_CAMERA_COLOURS_H_
#define LUXFIT_CALIB_COLOUR_CAMERA_COLOURS_H_

#include <Eigen/Core>
#include <optional>
#include <string>

namespace luxfit {

struct CameraColours {
  Eigen::Matrix3d xyz_from_rgb;
  std::string source;  // kSensorColours, or the name of a profile: "Display P3", "sRGB"
};

constexpr char kSensorColours[] = "the sensor's matrix";

CameraColours SrgbColours();

// Returns the sensor's matrix of a RAW file; none where the file is not RAW, cannot be opened, or its sensor is unknown.
std::optional<CameraColours> ReadSensorColours(const std::string& path);

// Returns the primaries that a photo's colour profile states, else sRGB's.
CameraColours ReadDisplayColours(const std::string& path);

// Returns the weights of red, green and blue in the luminance: the row of Y, divided by its sum.
inline Eigen::Vector3d LuminanceWeightsOf(const Eigen::Matrix3d& xyz_from_rgb) {
  return xyz_from_rgb.row(1).transpose() / xyz_from_rgb.row(1).sum();
}

}  // namespace luxfit

#endif  // LUXFIT_CALIB_COLOUR_CAMERA_COLOURS_H_
