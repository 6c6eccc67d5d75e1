#include "apps/session/photo_colours.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "calib/colour/camera_colours.h"

namespace luxfit {
namespace {

std::optional<CameraColours> ColoursOf(const SessionCamera& camera, const std::string& photo) {
  if (std::optional<CameraColours> sensor = ReadSensorColours(photo)) return sensor;
  if (camera.response == "srgb") return ReadDisplayColours(photo);
  return std::nullopt;
}

}  // namespace

Session WithColoursOfPhotos(Session session) {
  for (size_t c = 0; c < session.cameras.size(); ++c) {
    SessionCamera& camera = session.cameras[c];
    if (!camera.colours.empty()) continue;
    const auto first =
        std::find_if(session.photos.begin(), session.photos.end(),
                     [&](const SessionPhoto& photo) { return static_cast<size_t>(photo.camera) == c; });
    if (first == session.photos.end()) continue;
    const std::optional<CameraColours> found = ColoursOf(camera, first->file);
    if (!found) continue;
    camera.xyz_from_rgb = found->xyz_from_rgb;
    camera.luminance_weights = LuminanceWeightsOf(found->xyz_from_rgb);
    camera.colours = found->source;
  }
  return session;
}

}  // namespace luxfit
