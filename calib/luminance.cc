#include "calib/luminance.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace luxfit {
namespace {

// Marks every pixel within `margin_px` (square neighbourhood) of a marked one; rows, then columns.
PixelMask Dilate(PixelMask mask, int margin_px) {
  if (margin_px <= 0 || !mask.any()) return mask;
  const Eigen::Index height = mask.rows(), width = mask.cols();
  PixelMask along_rows = PixelMask::Constant(height, width, false);
  for (Eigen::Index v = 0; v < height; ++v) {
    for (Eigen::Index u = 0; u < width; ++u) {
      if (!mask(v, u)) continue;
      const Eigen::Index first = std::max<Eigen::Index>(0, u - margin_px);
      const Eigen::Index last = std::min<Eigen::Index>(width - 1, u + margin_px);
      for (Eigen::Index i = first; i <= last; ++i) along_rows(v, i) = true;
    }
  }
  PixelMask dilated = along_rows;
  for (Eigen::Index v = 0; v < height; ++v) {
    const Eigen::Index first = std::max<Eigen::Index>(0, v - margin_px);
    const Eigen::Index last = std::min<Eigen::Index>(height - 1, v + margin_px);
    for (Eigen::Index i = first; i <= last; ++i) dilated.row(i) = dilated.row(i) || along_rows.row(v);
  }
  return dilated;
}

}  // namespace

LuminanceImage ToRelativeLuminance(const Photo& photo, double exposure_s, const LuminanceOptions& options) {
  if (!(exposure_s > 0) || !std::isfinite(exposure_s)) {
    throw std::invalid_argument("ToRelativeLuminance: exposure_s: expected > 0, got " +
                                std::to_string(exposure_s));
  }
  if (photo.rgb_counts[0].size() == 0) throw std::invalid_argument("ToRelativeLuminance: the photo is empty");
  const double range_counts = photo.full_scale_counts - options.black_level_counts;
  if (!(range_counts > 0)) {
    throw std::invalid_argument("ToRelativeLuminance: black_level_counts: expected below full scale (" +
                                std::to_string(photo.full_scale_counts) + "), got " +
                                std::to_string(options.black_level_counts));
  }

  const ImagePlane& red = photo.rgb_counts[0];
  const ImagePlane& green = photo.rgb_counts[1];
  const ImagePlane& blue = photo.rgb_counts[2];
  const float scale = static_cast<float>(1.0 / (range_counts * exposure_s));
  const Eigen::Vector3f weights = options.weights.cast<float>();
  const float black = static_cast<float>(options.black_level_counts);
  const float saturated_counts = static_cast<float>(options.saturation_fraction * photo.saturation_counts);
  // Floating-point files are not quantised: only what is not positive is dark in them.
  const float dark_fraction = photo.bits_per_channel == 32 ? 0.0f : static_cast<float>(options.dark_fraction);
  const float dark = static_cast<float>(dark_fraction / exposure_s);

  LuminanceImage image;
  for (size_t c = 0; c < 3; ++c) image.relative_rgb[c] = scale * (photo.rgb_counts[c] - black);
  image.relative_luminance = weights[0] * image.relative_rgb[0] + weights[1] * image.relative_rgb[1] +
                             weights[2] * image.relative_rgb[2];
  // Written so that NaN counts as saturated.
  PixelMask saturated = !(red < saturated_counts && green < saturated_counts && blue < saturated_counts);
  image.saturated = Dilate(std::move(saturated), options.saturation_margin_px);
  image.valid = !image.saturated && image.relative_luminance > dark;
  return image;
}

}  // namespace luxfit
