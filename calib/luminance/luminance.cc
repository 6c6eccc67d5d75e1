#include "calib/luminance/luminance.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

void CheckInput(const Photo& photo, double exposure_s, const LuminanceOptions& options) {
  if (!(exposure_s > 0) || !std::isfinite(exposure_s)) {
    throw std::invalid_argument("ToRelativeLuminance: exposure_s: expected > 0, got " +
                                std::to_string(exposure_s));
  }
  if (photo.rgb_counts[0].size() == 0) throw std::invalid_argument("ToRelativeLuminance: the photo is empty");
  if (!(photo.full_scale_counts > options.black_level_counts)) {
    throw std::invalid_argument("ToRelativeLuminance: black_level_counts: expected below full scale (" +
                                std::to_string(photo.full_scale_counts) + "), got " +
                                std::to_string(options.black_level_counts));
  }
  if (options.response && photo.bits_per_channel == 32)
    throw std::invalid_argument("ToRelativeLuminance: response: expected a photo of counts, got floats");
}

// Holds the exposure and the slope of every count of one channel.
struct ChannelTable {
  std::vector<float> exposure, slope;
};

ChannelTable TableOf(const CameraResponse& response, size_t channel, double full_scale_counts) {
  ChannelTable table;
  const size_t size = static_cast<size_t>(full_scale_counts) + 1;
  table.exposure.resize(size);
  table.slope.resize(size);
  for (size_t i = 0; i < size; ++i) {
    table.exposure[i] = static_cast<float>(response.Exposure(channel, static_cast<double>(i)));
    table.slope[i] = static_cast<float>(response.Slope(channel, static_cast<double>(i)));
  }
  return table;
}

// Returns one channel through the camera's response; adds its variance to `variance` unless that is empty.
ImagePlane ThroughResponse(const ImagePlane& counts, const ChannelTable& table, float per_exposure,
                           float weight, const LuminanceOptions& options, double full_scale_counts,
                           ImagePlane& variance) {
  ImagePlane relative(counts.rows(), counts.cols());
  const float last = static_cast<float>(table.exposure.size() - 1);
  for (Eigen::Index i = 0; i < counts.size(); ++i) {
    const float count = std::clamp(counts.data()[i], 0.0f, last);
    const size_t at = std::isfinite(count) ? static_cast<size_t>(count) : table.exposure.size() - 1;
    relative.data()[i] = per_exposure * table.exposure[at];
    if (variance.size() == 0) continue;
    const float slope = weight * per_exposure * static_cast<float>(full_scale_counts) * table.slope[at];
    variance.data()[i] +=
        slope * slope *
        static_cast<float>(options.noise->Variance(static_cast<double>(at) / full_scale_counts));
  }
  return relative;
}

void FillWithResponse(const Photo& photo, float per_exposure, const LuminanceOptions& options,
                      LuminanceImage& image) {
  for (size_t c = 0; c < 3; ++c) {
    image.relative_rgb[c] =
        ThroughResponse(photo.rgb_counts[c], TableOf(*options.response, c, photo.full_scale_counts),
                        per_exposure, static_cast<float>(options.weights[static_cast<Eigen::Index>(c)]),
                        options, photo.full_scale_counts, image.variance);
  }
}

void FillLinear(const Photo& photo, double exposure_s, const LuminanceOptions& options,
                LuminanceImage& image) {
  const float black = static_cast<float>(options.black_level_counts);
  const float per_exposure = static_cast<float>(1 / exposure_s);
  const float scale =
      static_cast<float>(1 / ((photo.full_scale_counts - options.black_level_counts) * exposure_s));
  for (size_t c = 0; c < 3; ++c) {
    image.relative_rgb[c] = scale * (photo.rgb_counts[c] - black);
    if (image.variance.size() == 0) continue;
    const float weight = static_cast<float>(options.weights[static_cast<Eigen::Index>(c)]);
    const float read = static_cast<float>(options.noise->read) * per_exposure;
    const float shot = static_cast<float>(options.noise->shot) * per_exposure;
    image.variance += weight * weight * (read * read + shot * image.relative_rgb[c].max(0.0f));
  }
}

// Marks the pixels below the dark limit; with a response, where any channel is.
PixelMask TooDark(const Photo& photo, double exposure_s, const LuminanceOptions& options,
                  const ImagePlane& relative_luminance) {
  if (options.response) {
    const float dark = static_cast<float>(options.dark_response_fraction * photo.full_scale_counts);
    return photo.rgb_counts[0] < dark || photo.rgb_counts[1] < dark || photo.rgb_counts[2] < dark;
  }
  // Float files are not quantised: a value is dark only where it is not positive.
  const float dark_fraction = photo.bits_per_channel == 32 ? 0.0f : static_cast<float>(options.dark_fraction);
  return !(relative_luminance > static_cast<float>(dark_fraction / exposure_s));
}

}  // namespace

LuminanceImage ToRelativeLuminance(const Photo& photo, double exposure_s, const LuminanceOptions& options) {
  CheckInput(photo, exposure_s, options);
  LuminanceImage image;
  if (options.noise)
    image.variance = ImagePlane::Zero(photo.rgb_counts[0].rows(), photo.rgb_counts[0].cols());
  if (options.response) {
    FillWithResponse(photo, static_cast<float>(1 / exposure_s), options, image);
  } else {
    FillLinear(photo, exposure_s, options, image);
  }
  const Eigen::Vector3f weights = options.weights.cast<float>();
  image.relative_luminance = weights[0] * image.relative_rgb[0] + weights[1] * image.relative_rgb[1] +
                             weights[2] * image.relative_rgb[2];
  // The comparison is negated so that NaN counts as saturated.
  const float limit = static_cast<float>(options.saturation_fraction * photo.saturation_counts);
  PixelMask saturated =
      !(photo.rgb_counts[0] < limit && photo.rgb_counts[1] < limit && photo.rgb_counts[2] < limit);
  image.saturated = Dilate(std::move(saturated), options.saturation_margin_px);
  image.valid = !image.saturated && !TooDark(photo, exposure_s, options, image.relative_luminance);
  return image;
}

LuminanceImage WithoutVignetting(LuminanceImage image, const Vignetting& vignetting) {
  const ImagePlane transmission =
      VignettingImage(vignetting, static_cast<int>(image.relative_luminance.cols()),
                      static_cast<int>(image.relative_luminance.rows()));
  for (ImagePlane& plane : image.relative_rgb) plane /= transmission;
  image.relative_luminance /= transmission;
  if (image.variance.size() > 0) image.variance /= transmission.square();
  return image;
}

double PhotoCorrection::LogFactor(double log_share, double radius2) const {
  double factor = exponent * log_share - log_gain, power = 1;
  for (const double a : vignetting) factor -= a * (power *= radius2);
  return factor;
}

LuminanceImage WithCorrection(LuminanceImage image, const PhotoCorrection& correction, double exposure_s) {
  if (correction.log_gain == 0 && correction.exponent == 0 && correction.vignetting.empty()) return image;
  ImagePlane& plane = image.relative_luminance;
  const Vignetting frame = NoVignetting(static_cast<int>(plane.cols()), static_cast<int>(plane.rows()));
  for (Eigen::Index v = 0; v < plane.rows(); ++v) {
    for (Eigen::Index u = 0; u < plane.cols(); ++u) {
      const double y = plane(v, u);
      if (!(y > 0)) continue;
      const double radius2 = frame.Radius2At({static_cast<double>(u), static_cast<double>(v)});
      const auto factor =
          static_cast<float>(std::exp(correction.LogFactor(std::log(y * exposure_s), radius2)));
      plane(v, u) *= factor;
      for (ImagePlane& channel : image.relative_rgb) channel(v, u) *= factor;
      if (image.variance.size() > 0) image.variance(v, u) *= factor * factor;
    }
  }
  return image;
}

LuminanceImage WithoutAmbient(LuminanceImage image, const LuminanceImage& ambient, double share) {
  if (image.valid.rows() != ambient.valid.rows() || image.valid.cols() != ambient.valid.cols())
    throw std::invalid_argument("WithoutAmbient: expected images of one size");
  const auto factor = static_cast<float>(share);
  for (size_t c = 0; c < 3; ++c) image.relative_rgb[c] -= factor * ambient.relative_rgb[c];
  image.relative_luminance -= factor * ambient.relative_luminance;
  if (image.variance.size() > 0 && ambient.variance.size() > 0)
    image.variance += factor * factor * ambient.variance;
  image.saturated = image.saturated || ambient.saturated;
  // Ambient pixels that are too dark stay valid: the light subtracted there is below the image's own dark
  // limit.
  image.valid = image.valid && !ambient.saturated;
  return image;
}

SensorNoise DefaultNoise(int bits_per_channel) {
  SensorNoise noise;
  if (bits_per_channel == 8) {
    noise.read = 1.0 / 255;
    noise.shot = 0;
  }
  return noise;
}

}  // namespace luxfit
