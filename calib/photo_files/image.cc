#include "calib/photo_files/image.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "calib/photo_files/internal/heif_photo.h"
#include "calib/photo_files/internal/radiance_header.h"
#include "calib/photo_files/internal/raw_photo.h"
#include "calib/photo_files/internal/tiff_compression.h"
#include "calib/photo_files/internal/write_image.h"

namespace luxfit {
namespace {

cv::Mat ReadFile(const std::string& path) {
  cv::Mat image;
  std::string detail;
  try {
    // Anything but UNCHANGED truncates to 8 bits and rotates by EXIF.
    image = cv::imread(path, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& e) {
    detail = " (" + e.err + ")";
  }
  if (image.empty()) {
    throw std::runtime_error(path +
                             ": cannot read the photo, expected PNG or TIFF (8 or 16 bit), EXR, TIFF, PFM or "
                             "Radiance HDR (float), RAW, JPEG or HEIC" +
                             detail);
  }
  return image;
}

// Splits OpenCV's planes (blue, green, red[, alpha]) into red, green, blue.
template <typename T>
void Deinterleave(const cv::Mat& image, Photo& photo) {
  const int channels = image.channels();
  for (ImagePlane& plane : photo.rgb_counts) plane.resize(image.rows, image.cols);
  if (channels == 1) {
    for (int v = 0; v < image.rows; ++v) {
      const T* source = image.ptr<T>(v);
      float* grey = &photo.rgb_counts[0](v, 0);
      for (int u = 0; u < image.cols; ++u) grey[u] = static_cast<float>(source[u]);
    }
    photo.rgb_counts[1] = photo.rgb_counts[0];
    photo.rgb_counts[2] = photo.rgb_counts[0];
    return;
  }
  for (int v = 0; v < image.rows; ++v) {
    const T* source = image.ptr<T>(v);
    float* red = &photo.rgb_counts[0](v, 0);
    float* green = &photo.rgb_counts[1](v, 0);
    float* blue = &photo.rgb_counts[2](v, 0);
    for (int u = 0; u < image.cols; ++u, source += channels) {
      blue[u] = static_cast<float>(source[0]);
      green[u] = static_cast<float>(source[1]);
      red[u] = static_cast<float>(source[2]);
    }
  }
}

double LargestFiniteCount(const Photo& photo) {
  float largest = 0;
  for (const ImagePlane& plane : photo.rgb_counts)
    largest = std::max(largest, plane.isFinite().select(plane, 0.0f).maxCoeff());
  return largest;
}

}  // namespace

Photo ReadPhoto(const std::string& path) {
  if (!std::ifstream(path, std::ios::binary)) {
    throw std::runtime_error(path + ": cannot read the photo, expected an existing file that may be read");
  }
  if (IsRawName(path)) return ReadRawPhoto(path);
  if (IsHeifName(path)) return ReadHeifPhoto(path);
  const auto radiance = ReadRadianceHeader(path);
  const cv::Mat image = ReadFile(path);
  const int channels = image.channels();
  if (channels != 1 && channels != 3 && channels != 4) {
    throw std::runtime_error(path + ": cannot read the photo, expected 1, 3 or 4 channels, got " +
                             std::to_string(channels));
  }
  Photo photo;
  switch (image.depth()) {
    case CV_8U:
      Deinterleave<unsigned char>(image, photo);
      photo.bits_per_channel = 8;
      photo.full_scale_counts = photo.saturation_counts = 255.0;
      break;
    case CV_16U:
      Deinterleave<unsigned short>(image, photo);
      photo.bits_per_channel = 16;
      photo.full_scale_counts = photo.saturation_counts = 65535.0;
      break;
    case CV_32F:
    case CV_64F:
      if (IsLogLuvTiff(path)) {
        throw std::runtime_error(path +
                                 ": cannot read the photo, expected a TIFF of plain floats, got LogLuv, "
                                 "which programs write wrongly by factors; save it without compression");
      }
      if (image.depth() == CV_32F) {
        Deinterleave<float>(image, photo);
      } else {
        Deinterleave<double>(image, photo);
      }
      photo.bits_per_channel = 32;
      photo.full_scale_counts = 1.0;
      if (radiance) {
        for (size_t c = 0; c < 3; ++c) photo.rgb_counts[c] /= static_cast<float>(radiance->multiplier[c]);
      }
      photo.saturation_counts = LargestFiniteCount(photo);
      break;
    default:
      throw std::runtime_error(path +
                               ": cannot read the photo, expected 8 or 16 bit unsigned or float counts");
  }
  return photo;
}

void WriteExr(const std::string& path, const std::array<ImagePlane, 3>& rgb) {
  for (const ImagePlane& plane : rgb) {
    if (plane.rows() != rgb[0].rows() || plane.cols() != rgb[0].cols() || plane.size() == 0)
      throw std::invalid_argument("WriteExr: expected three planes of one size");
  }
  cv::Mat image(static_cast<int>(rgb[0].rows()), static_cast<int>(rgb[0].cols()), CV_32FC3);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u)
      image.at<cv::Vec3f>(v, u) = {rgb[2](v, u), rgb[1](v, u), rgb[0](v, u)};
  }
  WriteImageFile(path, image);
}

}  // namespace luxfit
