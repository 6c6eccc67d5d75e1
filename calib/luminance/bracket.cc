#include "calib/luminance/bracket.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace luxfit {
namespace {

// Returns the variance of the exposure of every count, as a share of full scale.
std::vector<float> VarianceOfCounts(const LuminanceOptions& options, size_t channel,
                                    double full_scale_counts) {
  std::vector<float> variance(static_cast<size_t>(full_scale_counts) + 1);
  for (size_t i = 0; i < variance.size(); ++i) {
    const double count = static_cast<double>(i);
    if (options.response->has_relative_sigma()) {
      const double sigma =
          options.response->Exposure(channel, count) * options.response->RelativeSigma(channel, count);
      variance[i] = std::max(1e-20f, static_cast<float>(sigma * sigma));
      continue;
    }
    const double slope = full_scale_counts * options.response->Slope(channel, count);
    variance[i] = static_cast<float>(slope * slope * options.noise->Variance(count / full_scale_counts));
  }
  return variance;
}

}  // namespace

void BracketMerger::AddChannel(size_t channel, const Photo& photo, const ImagePlane& relative,
                               const PixelMask& used, double exposure_s) {
  ImagePlane& weight_sum = weight_sum_[channel];
  ImagePlane& weighted_sum = weighted_sum_[channel];
  std::vector<float> table;
  if (options_.response) table = VarianceOfCounts(options_, channel, photo.full_scale_counts);
  const float t = static_cast<float>(exposure_s), t2 = t * t;
  const float read = static_cast<float>(options_.noise->read * options_.noise->read);
  const float shot = static_cast<float>(options_.noise->shot);
  for (Eigen::Index i = 0; i < relative.size(); ++i) {
    const float value = relative.data()[i];
    if (weight_sum.data()[i] == 0) weighted_sum.data()[i] = 0;
    if (!used.data()[i]) {
      // Where no exposure counts, the pixel shows the shortest one, which is the least saturated.
      if (weight_sum.data()[i] == 0) weighted_sum.data()[i] = value;
      continue;
    }
    float variance = 0;
    if (options_.response) {
      const float count =
          std::clamp(photo.rgb_counts[channel].data()[i], 0.0f, static_cast<float>(table.size() - 1));
      variance = table[static_cast<size_t>(count)];
    } else {
      const float sum = weight_sum.data()[i];
      const float expected = sum > 0 ? weighted_sum.data()[i] / sum : value;
      variance = read + shot * std::max(0.0f, expected * t);
    }
    const float weight = t2 / variance;
    weight_sum.data()[i] += weight;
    weighted_sum.data()[i] += weight * value;
  }
}

void BracketMerger::Add(const Photo& photo, double exposure_s) {
  if (last_exposure_s_ > 0 && !(exposure_s <= last_exposure_s_))
    throw std::invalid_argument("BracketMerger: expected exposures from the longest to the shortest");
  const Eigen::Index height = photo.rgb_counts[0].rows(), width = photo.rgb_counts[0].cols();
  if (last_exposure_s_ == 0) {
    if (!options_.noise) options_.noise = DefaultNoise(photo.bits_per_channel);
    for (size_t c = 0; c < 3; ++c) weight_sum_[c] = weighted_sum_[c] = ImagePlane::Zero(height, width);
    dark_limit_ = ImagePlane::Zero(height, width);
    saturated_ = PixelMask::Constant(height, width, true);
  } else if (saturated_.rows() != height || saturated_.cols() != width) {
    throw std::invalid_argument("BracketMerger: expected photos of one size");
  }
  LuminanceOptions single = options_;
  single.noise.reset();
  const LuminanceImage image = ToRelativeLuminance(photo, exposure_s, single);
  const PixelMask used = options_.response ? image.valid : PixelMask(!image.saturated);
  for (size_t c = 0; c < 3; ++c) AddChannel(c, photo, image.relative_rgb[c], used, exposure_s);
  const double dark = photo.bits_per_channel == 32 || options_.response ? 0 : options_.dark_fraction;
  // The first unsaturated exposure is the longest. A limit of 0 would read as "none yet".
  const float limit = std::max(1e-30f, static_cast<float>(dark / exposure_s));
  dark_limit_ = (dark_limit_ == 0.0f && !image.saturated).select(limit, dark_limit_);
  saturated_ = saturated_ && image.saturated;
  last_exposure_s_ = exposure_s;
}

LuminanceImage BracketMerger::Merged() const {
  if (last_exposure_s_ == 0) throw std::invalid_argument("BracketMerger: expected one exposure or more");
  const Eigen::Index height = saturated_.rows(), width = saturated_.cols();
  LuminanceImage image;
  image.relative_luminance = ImagePlane::Zero(height, width);
  image.variance = ImagePlane::Zero(height, width);
  for (size_t c = 0; c < 3; ++c) {
    const float weight = static_cast<float>(options_.weights[static_cast<Eigen::Index>(c)]);
    const auto known = weight_sum_[c] > 0.0f;
    image.relative_rgb[c] = known.select(weighted_sum_[c] / weight_sum_[c], weighted_sum_[c]);
    image.relative_luminance += weight * image.relative_rgb[c];
    image.variance += known.select(weight * weight / weight_sum_[c], 0.0f);
  }
  image.saturated = saturated_;
  image.valid = !saturated_ && weight_sum_[1] > 0.0f && image.relative_luminance > dark_limit_;
  return image;
}

}  // namespace luxfit
