// Reads photos as counts, and writes pictures as OpenEXR.
//
// A photo is read as the camera wrote it: no gamma, no 8-bit truncation, no EXIF rotation, no white balance.
// RAW gives the sensor's counts less the black levels that the file states, its mosaic interpolated
// bilinearly at full size. Radiance pictures are divided by the EXPOSURE of their header.
//
// Planes are row-major arrays of height x width counts; pixel (u, v) = (column, row) is plane(v, u), and (0,
// 0) is the centre of the top-left pixel. A monochrome photo gives three equal planes.
//
// Throws std::runtime_error, naming the file, where it is missing, unreadable, or not of 1, 3 or 4 channels.
// Throws it also for a LogLuv TIFF, which holds luminance to percents only.
#ifndef LUXFIT_CALIB_PHOTO_FILES_IMAGE_H_
#define LUXFIT_CALIB_PHOTO_FILES_IMAGE_H_

#include <Eigen/Core>
#include <array>
#include <string>

namespace luxfit {

// height x width
using ImagePlane = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using PixelMask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  // true: usable

struct Photo {
  std::array<ImagePlane, 3> rgb_counts;  // red, green, blue
  int bits_per_channel = 16;             // 8, 16 or 32 (float)
  double full_scale_counts = 65535.0;    // as saturation_counts; 1 for float files: photos share one scale
  // Counts at which the file clips: 255, 65535; RAW: the white level less black; float: its largest count.
  double saturation_counts = 65535.0;
  bool is_black_subtracted = false;  // RAW: the file states its black level

  int width_px() const { return static_cast<int>(rgb_counts[0].cols()); }
  int height_px() const { return static_cast<int>(rgb_counts[0].rows()); }
};

// Reads RAW (DNG, CR2, NEF, ARW, ...), PNG and TIFF (8 or 16 bit), EXR, TIFF, PFM and Radiance HDR (float),
// JPEG, HEIC and HEIF.
Photo ReadPhoto(const std::string& path);

// Writes three float planes of one size as an OpenEXR picture, whole or not at all. Throws
// std::runtime_error, naming the file, where it cannot be written, and std::invalid_argument for planes that
// differ in size.
void WriteExr(const std::string& path, const std::array<ImagePlane, 3>& rgb);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_PHOTO_FILES_IMAGE_H_
