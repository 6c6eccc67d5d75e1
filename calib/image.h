// Photos as linear counts.
//
// A photo is read as the camera wrote it: no gamma, no 8-bit truncation, no EXIF rotation. Planes are
// row-major arrays of height x width counts; pixel (u, v) = (column, row) is plane(v, u), and (0, 0) is the
// centre of the top-left pixel. A monochrome photo gives three equal planes.
//
// Throws std::runtime_error naming the file when it is missing, unreadable, or not of 1, 3 or 4 channels.
#ifndef LUXFIT_CALIB_IMAGE_H_
#define LUXFIT_CALIB_IMAGE_H_

#include <Eigen/Core>
#include <array>
#include <string>

namespace luxfit {

// height x width
using ImagePlane = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Photo {
  std::array<ImagePlane, 3> rgb_counts;  // red, green, blue
  int bits_per_channel = 16;             // 8, 16 or 32 (float)
  double full_scale_counts = 65535.0;    // 255, 65535; 1 for float files, so that photos share one scale
  double saturation_counts =
      65535.0;  // where the file can clip: 255, 65535; float: the largest count in the file

  int width_px() const { return static_cast<int>(rgb_counts[0].cols()); }
  int height_px() const { return static_cast<int>(rgb_counts[0].rows()); }
};

// PNG, TIFF (8 or 16 bit) and EXR, TIFF, PFM (float).
Photo ReadPhoto(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_IMAGE_H_
