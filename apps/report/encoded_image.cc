#include "apps/report/encoded_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

namespace luxfit {
namespace {

uint8_t LevelOf(float relative) {
  if (!std::isfinite(relative)) return 255;
  const double x = std::clamp(static_cast<double>(relative), 0.0, 1.0);
  const double level = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<uint8_t>(std::lround(255 * level));
}

std::vector<uint8_t> Encode(const DisplayPicture& picture, const std::string& extension,
                            const std::vector<int>& parameters) {
  const size_t pixels = static_cast<size_t>(picture.width_px) * static_cast<size_t>(picture.height_px);
  if (pixels == 0 || picture.rgb.size() != 3 * pixels)
    throw std::invalid_argument("Encode: expected three levels a pixel");
  const cv::Mat rgb(picture.height_px, picture.width_px, CV_8UC3, const_cast<uint8_t*>(picture.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  std::vector<uint8_t> bytes;
  if (!cv::imencode(extension, bgr, bytes, parameters))
    throw std::runtime_error("expected a picture that can be encoded as " + extension + ", got none");
  return bytes;
}

}  // namespace

DisplayPicture ToDisplay(const std::array<ImagePlane, 3>& linear_rgb, double white) {
  DisplayPicture picture{static_cast<int>(linear_rgb[0].cols()), static_cast<int>(linear_rgb[0].rows()), {}};
  const float scale = white > 0 ? static_cast<float>(1 / white) : 0.0f;
  const Eigen::Index pixels = linear_rgb[0].size();
  if (linear_rgb[1].size() != pixels || linear_rgb[2].size() != pixels)
    throw std::invalid_argument("ToDisplay: expected three planes of one size");
  picture.rgb.reserve(3 * static_cast<size_t>(pixels));
  for (Eigen::Index i = 0; i < pixels; ++i) {
    for (const ImagePlane& plane : linear_rgb) picture.rgb.push_back(LevelOf(scale * plane.data()[i]));
  }
  return picture;
}

ImagePlane Reduced(const ImagePlane& plane, int width_px) {
  if (width_px < 1) throw std::invalid_argument("Reduced: expected width_px >= 1");
  if (plane.cols() <= width_px) return plane;
  const int height_px =
      std::max(1, static_cast<int>(std::lround(static_cast<double>(plane.rows()) * width_px /
                                               static_cast<double>(plane.cols()))));
  ImagePlane reduced(height_px, width_px);
  const cv::Mat from(static_cast<int>(plane.rows()), static_cast<int>(plane.cols()), CV_32F,
                     const_cast<float*>(plane.data()));
  cv::Mat to(height_px, width_px, CV_32F, reduced.data());
  cv::resize(from, to, to.size(), 0, 0, cv::INTER_AREA);
  return reduced;
}

std::vector<uint8_t> EncodeJpeg(const DisplayPicture& picture) {
  constexpr int kQuality = 85;
  return Encode(picture, ".jpg", {cv::IMWRITE_JPEG_QUALITY, kQuality});
}

std::vector<uint8_t> EncodePng(const DisplayPicture& picture) { return Encode(picture, ".png", {}); }

}  // namespace luxfit
