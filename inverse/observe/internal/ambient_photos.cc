#include "inverse/observe/internal/ambient_photos.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace luxfit {
namespace {

// Returns by state whether all luminaires are off. None is where nobody names the luminaires: some of them are on.
std::vector<bool> DarkStates(const StateTable& states) {
  std::vector<bool> is_dark;
  for (const Eigen::VectorXd& dimming : states.dimming)
    is_dark.push_back(!states.luminaires.empty() && (dimming.array() == 0).all());
  return is_dark;
}

// Returns the photo of each photo's view with all luminaires off; nothing where there is none.
std::vector<std::optional<size_t>> OffPhotos(const RoomPhotos& photos, const std::vector<bool>& is_dark) {
  std::vector<std::optional<size_t>> off(photos.photos.size());
  for (size_t i = 0; i < off.size(); ++i) {
    const RoomPhoto& photo = photos.photos[i];
    const auto dark = std::find_if(photos.photos.begin(), photos.photos.end(), [&](const RoomPhoto& other) {
      return other.view == photo.view && other.camera == photo.camera &&
             is_dark[static_cast<size_t>(other.state)];
    });
    if (dark != photos.photos.end()) off[i] = static_cast<size_t>(dark - photos.photos.begin());
  }
  return off;
}

// Returns the luminance of every element in every photo, as they are.
std::vector<Observation> ObserveAsTheyAre(const std::vector<PixelMap>& maps, const RoomPhotos& photos,
                                          const std::vector<RegisteredView>& views) {
  std::vector<std::vector<Observation>> of_photo(photos.photos.size());
  tbb::parallel_for(size_t{0}, of_photo.size(), [&](size_t i) {
    const RoomPhoto& photo = photos.photos[i];
    const auto view = ViewOf(photo, views);
    if (view) of_photo[i] = ObservePhoto(maps[*view], *photos.read(i), static_cast<int>(*view), photo.state);
  });
  std::vector<Observation> observations;
  for (const std::vector<Observation>& some : of_photo)
    observations.insert(observations.end(), some.begin(), some.end());
  return observations;
}

}  // namespace

bool HasAmbient(const RoomPhotos& photos, const StateTable& states) {
  const std::vector<bool> is_dark = DarkStates(states);
  return std::any_of(photos.photos.begin(), photos.photos.end(), [&](const RoomPhoto& photo) {
    return !is_dark.empty() && is_dark[static_cast<size_t>(photo.state)];
  });
}

AmbientPhotos::AmbientPhotos(const Room& room, const std::vector<PixelMap>& maps, const RoomPhotos& photos,
                             const std::vector<RegisteredView>& views, const StateTable& states)
    : is_dark_(DarkStates(states)),
      off_(OffPhotos(photos, is_dark_)),
      gains_(StatedGains(photos)),
      light_(EstimateAmbientLight(
          room.patches, InOneUnit(ObserveAsTheyAre(maps, photos, views), photos, views), states.dimming)) {}

std::vector<std::string> AmbientPhotos::ViewsWithout(const RoomPhotos& photos) const {
  std::vector<std::string> views;
  for (size_t i = 0; i < off_.size(); ++i) {
    const std::string& view = photos.photos[i].view;
    if (!off_[i] && std::count(views.begin(), views.end(), view) == 0) views.push_back(view);
  }
  return views;
}

std::shared_ptr<const LuminanceImage> AmbientPhotos::Read(const RoomPhotos& photos, size_t photo,
                                                          int view) const {
  const std::optional<size_t>& off = off_[photo];
  if (!off) return photos.read(photo);
  return std::make_shared<const LuminanceImage>(WithoutAmbient(
      *photos.read(photo), *photos.read(*off), light_.ShareOf(view, photos.photos[photo].state)));
}

std::vector<Observation> AmbientPhotos::Noted(const std::vector<Observation>& observations,
                                              const RoomPhotos& photos, size_t photo) const {
  const bool is_subtracted = off_[photo].has_value();
  const double gain = gains_[static_cast<size_t>(photos.photos[photo].camera)];
  std::vector<Observation> noted;
  for (Observation o : observations) {
    const auto off = light_.off.find({o.view, o.element});
    if (off == light_.off.end() && !is_subtracted) continue;
    if (off != light_.off.end()) {
      const double share = gain * light_.ShareOf(o.view, o.state);
      o.relative_ambient = share * off->second.relative_luminance;
      if (!is_subtracted) {
        o.relative_luminance -= o.relative_ambient;
        o.relative_rgb -= share * off->second.relative_rgb;
        o.variance += share * share * off->second.variance;
      }
    }
    if (o.relative_luminance > 0) noted.push_back(o);
  }
  return noted;
}

}  // namespace luxfit
