// Maps a photo's tones as operators for displays do. Nothing of them is shared with what is to find them.
//
// Counts are linear, of three channels in OpenCV's order; what is returned is of doubles, the brightest green 1.
// Sources: Reinhard et al. (2002), "Photographic tone reproduction for digital images", eqs. 1, 2 and 9, of one scale; Durand and
// Dorsey (2002), "Fast bilateral filtering for the display of high-dynamic-range images", sec. 5; Zuiderveld (1994), "Contrast
// limited adaptive histogram equalization".
#ifndef LUXFIT_TESTS_SUPPORT_LOCAL_TONES_H_
#define LUXFIT_TESTS_SUPPORT_LOCAL_TONES_H_

#include <array>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

namespace luxfit::support {

namespace internal {

inline double DiagonalPx(const cv::Mat& image) { return std::hypot(image.rows, image.cols); }

inline cv::Mat Green(const cv::Mat& light) {
  std::array<cv::Mat, 3> channels;
  cv::split(light, channels.data());
  return channels[1] / cv::mean(channels[1])[0];
}

inline cv::Mat Logarithm(const cv::Mat& grey) {
  cv::Mat logarithm;
  cv::log(cv::max(grey, 1e-4), logarithm);
  return logarithm;
}

// Multiplies each pixel by what `factor` returns of its green, and scales the whole.
inline cv::Mat WithFactor(const cv::Mat& counts, const std::function<cv::Mat(const cv::Mat& green)>& factor) {
  cv::Mat light;
  counts.convertTo(light, CV_64FC3);
  const cv::Mat of_pixel = factor(Green(light));
  light.forEach<cv::Vec3d>(
      [&](cv::Vec3d& pixel, const int* at) { pixel *= of_pixel.at<double>(at[0], at[1]); });
  std::array<cv::Mat, 3> channels;
  cv::split(light, channels.data());
  double brightest = 0;
  cv::minMaxLoc(channels[1], nullptr, &brightest);
  return light / brightest;
}

}  // namespace internal

// L / (1 + V), V: L smoothed by 3 % of the diagonal, both scaled to a mean grey of 0.18 before.
inline cv::Mat WithLocalTones(const cv::Mat& counts) {
  return internal::WithFactor(counts, [](cv::Mat green) -> cv::Mat {
    green *= 0.18 / std::exp(cv::mean(internal::Logarithm(green))[0]);
    cv::Mat around;
    cv::GaussianBlur(green, around, cv::Size(), 0.03 * internal::DiagonalPx(green));
    return 1 / (1 + around);
  });
}

// L exp(-strength b), b: ln L smoothed by `sigma` of the diagonal.
inline cv::Mat WithCompressedSurround(const cv::Mat& counts, double sigma, double strength) {
  return internal::WithFactor(counts, [&](const cv::Mat& green) {
    cv::Mat base;
    cv::GaussianBlur(internal::Logarithm(green), base, cv::Size(), sigma * internal::DiagonalPx(green));
    cv::exp(-strength * base, base);
    return base;
  });
}

// The same with a smoothing that keeps edges of more than a factor of 2.5: nearly one curve for the whole picture.
inline cv::Mat WithBilateralBase(const cv::Mat& counts, double strength) {
  return internal::WithFactor(counts, [&](const cv::Mat& green) {
    cv::Mat small, base;
    internal::Logarithm(green).convertTo(small, CV_32F);
    cv::resize(small, small, cv::Size(), 0.25, 0.25, cv::INTER_AREA);
    cv::bilateralFilter(small, base, -1, 0.92, 0.02 * internal::DiagonalPx(small));
    cv::resize(base, base, green.size());
    base.convertTo(base, CV_64F);
    cv::exp(-strength * base, base);
    return base;
  });
}

// Equalises the histogram of each of 8 x 8 tiles, with a contrast of 2 at most.
inline cv::Mat WithEqualisedTiles(const cv::Mat& counts) {
  return internal::WithFactor(counts, [](const cv::Mat& green) {
    cv::Mat encoded, equalised;
    cv::pow(cv::min(green / 4, 1), 1 / 2.4, encoded);
    encoded.convertTo(encoded, CV_16U, 65535);
    cv::createCLAHE(2, cv::Size(8, 8))->apply(encoded, equalised);
    cv::Mat before, after;
    encoded.convertTo(before, CV_64F);
    equalised.convertTo(after, CV_64F);
    cv::pow(after / cv::max(before, 1), 2.4, after);
    return after;
  });
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_LOCAL_TONES_H_
