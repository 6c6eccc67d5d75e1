#include "apps/export/false_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "apps/text/formats/artifact.h"

namespace luxfit {
namespace {

constexpr std::array<std::array<int, 3>, 9> kAnchors{{{68, 1, 84},
                                                      {71, 45, 123},
                                                      {59, 82, 139},
                                                      {44, 114, 142},
                                                      {33, 145, 140},
                                                      {40, 174, 128},
                                                      {94, 201, 98},
                                                      {173, 220, 48},
                                                      {253, 231, 37}}};

constexpr int kBarHeightPx = 14, kFooterPx = 44, kMarginPx = 24, kTicks = 5;

cv::Vec3b Bgr(const Eigen::Vector3i& rgb) {
  return {static_cast<unsigned char>(rgb[2]), static_cast<unsigned char>(rgb[1]),
          static_cast<unsigned char>(rgb[0])};
}

double ShareOf(double value, const ColourScale& scale) {
  return (value - scale.lower) / (scale.upper - scale.lower);
}

void DrawScale(cv::Mat& page, int top, const ColourScale& scale) {
  const int left = kMarginPx, right = std::max(left + 2, page.cols - kMarginPx);
  for (int u = left; u < right; ++u) {
    const cv::Vec3b colour = Bgr(FalseColour(static_cast<double>(u - left) / (right - 1 - left)));
    for (int v = 0; v < kBarHeightPx; ++v) page.at<cv::Vec3b>(top + 4 + v, u) = colour;
  }
  for (int i = 0; i < kTicks; ++i) {
    const double share = static_cast<double>(i) / (kTicks - 1);
    const double value = scale.lower + share * (scale.upper - scale.lower);
    const std::string text =
        i + 1 == kTicks ? fmt::format("{} {:g}", scale.label, value) : fmt::format("{:g}", value);
    int baseline = 0;
    const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.4, 1, &baseline);
    const int centre = left + static_cast<int>(share * (right - 1 - left));
    const int u = std::clamp(centre - size.width / 2, 2, std::max(2, page.cols - size.width - 2));
    cv::putText(page, text, {u, top + 4 + kBarHeightPx + 16}, cv::FONT_HERSHEY_SIMPLEX, 0.4, {0, 0, 0}, 1,
                cv::LINE_AA);
  }
}

}  // namespace

Eigen::Vector3i FalseColour(double t) {
  if (std::isnan(t)) return UnknownColour();
  const double at = std::clamp(t, 0.0, 1.0) * (kAnchors.size() - 1);
  const size_t low = std::min(static_cast<size_t>(at), kAnchors.size() - 2);
  const double share = at - static_cast<double>(low);
  Eigen::Vector3i colour;
  for (size_t i = 0; i < 3; ++i)
    colour[static_cast<Eigen::Index>(i)] =
        static_cast<int>(std::lround((1 - share) * kAnchors[low].at(i) + share * kAnchors[low + 1].at(i)));
  return colour;
}

Eigen::Vector3i UnknownColour() { return {200, 200, 200}; }

ColourScale ScaleOf(const ImagePlane& values, const std::string& label) {
  std::vector<float> known;
  known.reserve(static_cast<size_t>(values.size()));
  for (const float value : values.reshaped()) {
    if (std::isfinite(value)) known.push_back(value);
  }
  if (known.empty()) return {0, 1, label};
  const auto at = known.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(known.size() - 1));
  std::nth_element(known.begin(), at, known.end());
  const double high = *at;
  if (!(high > 0)) return {0, 1, label};
  const double decade = std::pow(10, std::floor(std::log10(high)));
  for (const double step : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0}) {
    if (step * decade >= high) return {0, step * decade, label};
  }
  return {0, 10 * decade, label};
}

void WriteFalseColourPng(const std::string& path, const ImagePlane& values, const ColourScale& scale) {
  const int rows = static_cast<int>(values.rows()), cols = static_cast<int>(values.cols());
  cv::Mat page(rows + kFooterPx, cols, CV_8UC3, cv::Scalar(255, 255, 255));
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < cols; ++u)
      page.at<cv::Vec3b>(v, u) = Bgr(FalseColour(ShareOf(static_cast<double>(values(v, u)), scale)));
  }
  DrawScale(page, rows, scale);
  std::vector<unsigned char> png;
  cv::imencode(".png", page, png);
  WriteText(path, {png.begin(), png.end()});
}

}  // namespace luxfit
