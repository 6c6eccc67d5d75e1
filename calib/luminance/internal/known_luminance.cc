#include "calib/luminance/internal/known_luminance.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace luxfit {

std::optional<LuminanceScale> ScaleFromKnownLuminance(const LuminanceImage& image, const PixelMask& patch,
                                                      double luminance_cd_m2, double relative_sigma,
                                                      double range_counts) {
  if (patch.rows() != image.valid.rows() || patch.cols() != image.valid.cols())
    throw std::invalid_argument("ScaleFromKnownLuminance: expected a patch of the image's size");
  if (!(luminance_cd_m2 > 0) || !(range_counts > 0) || !(relative_sigma >= 0))
    throw std::invalid_argument(
        "ScaleFromKnownLuminance: expected a luminance and a range > 0, a sigma >= 0");
  constexpr double kMinPixels = 10, kMinValidShare = 0.9;
  double pixels = 0, valid = 0, sum = 0, squares = 0;
  for (Eigen::Index i = 0; i < patch.size(); ++i) {
    if (!patch.data()[i]) continue;
    ++pixels;
    if (!image.valid.data()[i]) continue;
    const double y = static_cast<double>(image.relative_luminance.data()[i]);
    ++valid;
    sum += y;
    squares += y * y;
  }
  if (pixels < kMinPixels || valid < kMinValidShare * pixels || !(sum > 0)) return std::nullopt;
  const double mean = sum / valid;
  const double variance_of_mean = std::max(0.0, squares / valid - mean * mean) / (valid - 1);
  return LuminanceScale{luminance_cd_m2 / (mean * range_counts),
                        std::hypot(relative_sigma, std::sqrt(variance_of_mean) / mean)};
}

}  // namespace luxfit
