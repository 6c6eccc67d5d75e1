#include "calib/colour/camera_colours.h"

#include <libraw/libraw.h>

#include <Eigen/LU>
#include <cmath>
#include <memory>

#include "calib/luminance/colour_profile.h"
#include "calib/photo_files/internal/raw_photo.h"

namespace luxfit {

namespace {

// Takes a matrix of LibRaw's, whose fourth row is that of a fourth colour.
Eigen::Matrix3d MatrixOf(const float (&rows)[4][3]) {
  Eigen::Matrix3d matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix(row, column) = static_cast<double>(rows[row][column]);
  }
  return matrix;
}

// An unknown sensor has zeros.
bool IsStated(const Eigen::Matrix3d& rgb_from_xyz) {
  constexpr double kLeastDeterminant = 1e-6;
  return rgb_from_xyz.allFinite() && std::abs(rgb_from_xyz.determinant()) > kLeastDeterminant;
}

// Returns the ColorMatrix of a DNG: of two, that for daylight (EXIF's LightSource 20 to 23: D55, D65, D75, D50), else the
// second; LibRaw's for the model of other files.
Eigen::Matrix3d RgbFromXyz(const libraw_colordata_t& color) {
  Eigen::Matrix3d matrix = MatrixOf(color.cam_xyz);
  bool is_daylight = false;
  for (const libraw_dng_color_t& stated : color.dng_color) {
    const Eigen::Matrix3d own = MatrixOf(stated.colormatrix);
    if (!IsStated(own) || is_daylight) continue;
    matrix = own;
    is_daylight = stated.illuminant >= 20 && stated.illuminant <= 23;
  }
  return matrix;
}

}  // namespace

CameraColours SrgbColours() {
  Eigen::Matrix3d matrix;
  matrix << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  return {matrix, "sRGB"};
}

std::optional<CameraColours> ReadSensorColours(const std::string& path) {
  if (!IsRawName(path)) return std::nullopt;
  // LibRaw holds some hundred kilobytes: too much for the stack.
  const auto raw = std::make_unique<LibRaw>();
  if (raw->open_file(path.c_str()) != LIBRAW_SUCCESS || raw->imgdata.idata.colors != 3) return std::nullopt;
  const Eigen::Matrix3d rgb_from_xyz = RgbFromXyz(raw->imgdata.color);
  if (!IsStated(rgb_from_xyz)) return std::nullopt;
  const Eigen::Matrix3d matrix = rgb_from_xyz.inverse();
  if (!(matrix.row(1).sum() > 0)) return std::nullopt;
  return CameraColours{matrix, kSensorColours};
}

CameraColours ReadDisplayColours(const std::string& path) {
  const std::optional<ColourProfile> profile = ReadColourProfile(path);
  if (!profile || !profile->xyz_from_rgb) return SrgbColours();
  return {*profile->xyz_from_rgb, profile->name};
}

}  // namespace luxfit
