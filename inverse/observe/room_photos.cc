#include "inverse/observe/room_photos.h"

#include <algorithm>
#include <utility>

namespace luxfit {

LuminanceReader InMemory(std::vector<LuminanceImage> images) {
  const auto kept = std::make_shared<const std::vector<LuminanceImage>>(std::move(images));
  return [kept](size_t photo) { return std::shared_ptr<const LuminanceImage>(kept, &kept->at(photo)); };
}

int UnitCamera(const RoomPhotos& photos) {
  for (int c = 0; c < static_cast<int>(photos.cameras.size()); ++c) {
    const bool has_photos = std::any_of(photos.photos.begin(), photos.photos.end(),
                                        [&](const RoomPhoto& photo) { return photo.camera == c; });
    if (has_photos && photos.cameras[static_cast<size_t>(c)].cdm2_per_unit) return c;
  }
  return 0;
}

std::optional<double> StatedScale(const RoomPhotos& photos) {
  if (photos.cameras.empty()) return std::nullopt;
  const auto per_unit = photos.cameras[static_cast<size_t>(UnitCamera(photos))].cdm2_per_unit;
  return per_unit ? std::optional(1 / *per_unit) : std::nullopt;
}

std::vector<double> StatedGains(const RoomPhotos& photos) {
  std::vector<double> gains(photos.cameras.size(), 1.0);
  const auto unit = photos.cameras.at(static_cast<size_t>(UnitCamera(photos))).cdm2_per_unit;
  for (size_t c = 0; c < gains.size(); ++c) {
    const auto own = photos.cameras[c].cdm2_per_unit;
    if (unit && own) gains[c] = *unit / *own;
  }
  return gains;
}

std::optional<size_t> ViewOf(const RoomPhoto& photo, const std::vector<RegisteredView>& views) {
  const auto view =
      std::find_if(views.begin(), views.end(), [&](const RegisteredView& v) { return v.view == photo.view; });
  if (view == views.end()) return std::nullopt;
  return static_cast<size_t>(view - views.begin());
}

std::vector<Observation> InOneUnit(std::vector<Observation> observations, const RoomPhotos& photos,
                                   const std::vector<RegisteredView>& views) {
  const std::vector<double> gains = StatedGains(photos);
  for (Observation& o : observations) {
    const double gain = gains.at(static_cast<size_t>(views.at(static_cast<size_t>(o.view)).camera));
    o.relative_luminance /= gain;
    o.relative_rgb /= gain;
    o.relative_ambient /= gain;
    o.variance /= gain * gain;
  }
  return observations;
}

}  // namespace luxfit
