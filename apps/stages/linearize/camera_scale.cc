#include "apps/stages/linearize/camera_scale.h"

#include <algorithm>

namespace luxfit {

std::optional<double> LuminancePerUnit(const LinearizedCamera& camera) {
  if (!(camera.given.cdm2_per_count_s > 0)) return std::nullopt;
  return camera.given.cdm2_per_count_s * (camera.full_scale_counts - camera.given.black_level_counts);
}

int UnitCamera(const LinearizedPhotos& photos) {
  for (int c = 0; c < static_cast<int>(photos.cameras.size()); ++c) {
    const bool has_photos = std::any_of(photos.photos.begin(), photos.photos.end(),
                                        [&](const LinearizedPhoto& photo) { return photo.camera == c; });
    if (has_photos && LuminancePerUnit(photos.cameras[static_cast<size_t>(c)])) return c;
  }
  return 0;
}

std::vector<double> StatedGains(const LinearizedPhotos& photos) {
  std::vector<double> gains(photos.cameras.size(), 1.0);
  const auto unit = LuminancePerUnit(photos.cameras.at(static_cast<size_t>(UnitCamera(photos))));
  for (size_t c = 0; c < gains.size(); ++c) {
    const auto own = LuminancePerUnit(photos.cameras[c]);
    if (unit && own) gains[c] = *unit / *own;
  }
  return gains;
}

std::vector<Observation> InOneUnit(std::vector<Observation> observations, const LinearizedPhotos& photos,
                                   const std::vector<RegisteredView>& views) {
  const std::vector<double> gains = StatedGains(photos);
  for (Observation& o : observations) {
    const double gain = gains.at(static_cast<size_t>(views.at(static_cast<size_t>(o.view)).camera));
    o.relative_luminance /= gain;
    o.relative_rgb /= gain;
    o.variance /= gain * gain;
  }
  return observations;
}

}  // namespace luxfit
