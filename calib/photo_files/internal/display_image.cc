#include "calib/photo_files/internal/display_image.h"

#include <algorithm>
#include <cmath>

namespace luxfit {
namespace {

constexpr double kSaturatedFraction = 0.97;  // over the plane's largest value: luminaires in view
constexpr double kWhitePercentile = 0.99;    // among the pixels that are not saturated
constexpr int kPercentileStride = 5;         // every fifth pixel of the plane is enough

// Returns the value shown as white. Luminaires in view are hundreds of times as bright as walls: scaling to
// the largest value would leave a tag a handful of grey levels.
float WhiteLevel(const ImagePlane& grey) {
  float largest = 0;
  for (Eigen::Index i = 0; i < grey.size(); ++i) {
    if (std::isfinite(grey.data()[i])) largest = std::max(largest, grey.data()[i]);
  }
  std::vector<float> sample;
  sample.reserve(static_cast<std::size_t>(grey.size() / kPercentileStride + 1));
  for (Eigen::Index i = 0; i < grey.size(); i += kPercentileStride) {
    if (grey.data()[i] < kSaturatedFraction * largest) sample.push_back(grey.data()[i]);
  }
  if (sample.empty()) return largest;
  const auto white = sample.begin() + static_cast<std::ptrdiff_t>(kWhitePercentile * (sample.size() - 1));
  std::nth_element(sample.begin(), white, sample.end());
  return *white > 0 ? *white : largest;
}

}  // namespace

std::vector<uint8_t> DisplayImage(const ImagePlane& grey, double gamma) {
  constexpr int kLevels = 4096;
  std::vector<uint8_t> table(kLevels + 1);
  for (int i = 0; i <= kLevels; ++i) {
    // Entries are spaced by the square root of the value: the dark end, where gamma is steep, stays fine.
    const double value = std::pow(static_cast<double>(i) / kLevels, 2);
    table[static_cast<std::size_t>(i)] = static_cast<uint8_t>(std::lround(255 * std::pow(value, 1 / gamma)));
  }
  const float white = WhiteLevel(grey);
  const float scale = white > 0 ? 1 / white : 0;
  std::vector<uint8_t> display(static_cast<std::size_t>(grey.size()));
  for (Eigen::Index i = 0; i < grey.size(); ++i) {
    const float value = grey.data()[i] * scale;
    const float shown = std::isnan(value) ? 1.0f : std::clamp(value, 0.0f, 1.0f);
    display[static_cast<std::size_t>(i)] = table[static_cast<std::size_t>(std::sqrt(shown) * kLevels)];
  }
  return display;
}

}  // namespace luxfit
