#include "calib/luminance/luminance_spot.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

struct PixelSums {
  double luminance = 0, squares = 0, variance = 0;
};

void ExpectWithin(const LuminanceImage& image, const Eigen::Vector2d& pixel, double radius_px) {
  if (!(radius_px >= 1)) throw std::invalid_argument("MeasureSpot: radius_px: expected >= 1");
  const double right = static_cast<double>(image.relative_luminance.cols() - 1);
  const double bottom = static_cast<double>(image.relative_luminance.rows() - 1);
  const bool is_within = pixel.x() - radius_px >= 0 && pixel.y() - radius_px >= 0 &&
                         pixel.x() + radius_px <= right && pixel.y() + radius_px <= bottom;
  if (!is_within) throw std::invalid_argument("MeasureSpot: expected a circle within the image");
}

// Returns the common relative sigma of one channel of a merged bracket.
double ChannelSigma(const CameraResponse& response, size_t channel, double relative,
                    const std::vector<double>& exposures_s, const LuminanceOptions& options) {
  const double full_scale = response.counts()[response.counts().size() - 1];
  double sum = 0, squares = 0;
  for (const double exposure_s : exposures_s) {
    const double count = response.Counts(channel, relative * exposure_s);
    if (count < options.dark_response_fraction * full_scale ||
        count >= options.saturation_fraction * full_scale)
      continue;
    const double weight = 1 / response.RelativeSigma(channel, count);
    sum += weight;
    squares += weight * weight;
  }
  if (squares > 0) return sum / squares;
  const double shortest_s = *std::min_element(exposures_s.begin(), exposures_s.end());
  return response.RelativeSigma(channel, response.Counts(channel, relative * shortest_s));
}

}  // namespace

LuminanceSpot MeasureSpot(const LuminanceImage& image, const Eigen::Vector2d& pixel, double radius_px) {
  ExpectWithin(image, pixel, radius_px);
  LuminanceSpot spot;
  PixelSums sums;
  const auto first = [radius_px](double at) { return static_cast<Eigen::Index>(std::ceil(at - radius_px)); };
  const auto last = [radius_px](double at) { return static_cast<Eigen::Index>(std::floor(at + radius_px)); };
  for (Eigen::Index v = first(pixel.y()); v <= last(pixel.y()); ++v) {
    for (Eigen::Index u = first(pixel.x()); u <= last(pixel.x()); ++u) {
      const Eigen::Vector2d centre(static_cast<double>(u), static_cast<double>(v));
      if ((centre - pixel).squaredNorm() > radius_px * radius_px) continue;
      const double y = image.relative_luminance(v, u);
      ++spot.pixels;
      if (image.saturated(v, u)) {
        ++spot.saturated;
      } else if (!image.valid(v, u)) {
        ++spot.dark;
      }
      sums.luminance += y;
      sums.squares += y * y;
      if (image.variance.size() > 0) sums.variance += image.variance(v, u);
      for (size_t c = 0; c < 3; ++c)
        spot.relative_rgb[static_cast<Eigen::Index>(c)] += image.relative_rgb[c](v, u);
    }
  }
  const double n = spot.pixels;
  spot.relative_luminance = sums.luminance / n;
  spot.relative_rgb /= n;
  const double variance =
      std::max(0.0, (sums.squares - n * spot.relative_luminance * spot.relative_luminance) / (n - 1));
  spot.spread = std::sqrt(variance);
  spot.sigma = std::sqrt(std::max(variance, sums.variance / n) / n);
  return spot;
}

double ResponseSigma(const CameraResponse& response, const Eigen::Vector3d& relative_rgb,
                     const std::vector<double>& exposures_s, const LuminanceOptions& options) {
  if (exposures_s.empty()) throw std::invalid_argument("ResponseSigma: expected one exposure or more");
  if (!response.has_relative_sigma()) return 0;
  const Eigen::Vector3d share = options.weights.cwiseProduct(relative_rgb.cwiseMax(0));
  if (!(share.sum() > 0)) return 0;
  double sigma = 0;
  for (size_t c = 0; c < 3; ++c) {
    const auto i = static_cast<Eigen::Index>(c);
    sigma += share[i] * ChannelSigma(response, c, relative_rgb[i], exposures_s, options);
  }
  return sigma / share.sum();
}

}  // namespace luxfit
