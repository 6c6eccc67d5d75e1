#include "calib/luminance/cut_off.h"

#include <algorithm>
#include <map>

#include "calib/luminance/luminance.h"
#include "calib/luminance/median.h"
#include "calib/photo_files/internal/raw_photo.h"

namespace luxfit {
namespace {

constexpr size_t kNextLower = 16;
constexpr double kFewestPixels = 20;
constexpr double kTimesNextLower = 10;
constexpr size_t kFewestPhotos = 3;
constexpr double kExposuresDiffer = 1.1;

// Returns how many pixels have each count as the largest of their channels.
std::vector<double> PixelsOfCounts(const Photo& photo) {
  const auto last = static_cast<float>(photo.full_scale_counts);
  std::vector<double> pixels(static_cast<size_t>(photo.full_scale_counts) + 1);
  const auto& [red, green, blue] = photo.rgb_counts;
  for (Eigen::Index i = 0; i < red.size(); ++i) {
    const float largest = std::max({red.data()[i], green.data()[i], blue.data()[i]});
    ++pixels[static_cast<size_t>(std::clamp(largest, 0.0f, last))];
  }
  return pixels;
}

}  // namespace

std::optional<TopCount> TopCountOf(const Photo& photo) {
  if (photo.is_black_subtracted || photo.bits_per_channel == 32 || photo.rgb_counts[0].size() == 0)
    return std::nullopt;
  const std::vector<double> pixels = PixelsOfCounts(photo);
  size_t top = pixels.size() - 1;
  while (top > 0 && pixels[top] == 0) --top;
  std::vector<double> next_lower;
  for (size_t z = top; z-- > 0 && next_lower.size() < kNextLower;)
    if (pixels[z] > 0) next_lower.push_back(pixels[z]);
  // Pictures of a few flat tones, such as drawings, have plateaus everywhere.
  const bool is_plateau =
      static_cast<double>(top) < LuminanceOptions().saturation_fraction * photo.saturation_counts &&
      next_lower.size() == kNextLower && pixels[top] >= kFewestPixels &&
      pixels[top] > kTimesNextLower * Median(next_lower);
  return TopCount{static_cast<double>(top), is_plateau};
}

std::optional<TopCount> ReadTopCount(const std::string& path) {
  return IsRawName(path) ? std::nullopt : TopCountOf(ReadPhoto(path));
}

std::vector<double> FindCutOffs(const std::vector<ExposedTop>& photos) {
  std::map<double, std::vector<double>> exposures;  // of the photos with a plateau, by its counts
  for (const ExposedTop& photo : photos)
    if (photo.top.is_plateau) exposures[photo.top.counts].push_back(photo.exposure_s);
  std::vector<double> found;
  for (const auto& [counts, of_photos] : exposures) {
    const auto [least, most] = std::minmax_element(of_photos.begin(), of_photos.end());
    if (of_photos.size() >= kFewestPhotos && *most >= kExposuresDiffer * *least) found.push_back(counts);
  }
  return found;
}

}  // namespace luxfit
