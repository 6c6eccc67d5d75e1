#include "inverse/observe/room_signatures.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <memory>

namespace luxfit {

std::vector<SignatureView> SignaturesOf(const RoomPhotos& photos, const std::vector<Camera>& cameras,
                                        const std::vector<RegisteredView>& views, int states) {
  const std::vector<double> gains = StatedGains(photos);
  std::vector<SignatureView> signatures(views.size());
  tbb::parallel_for(size_t{0}, views.size(), [&](size_t v) {
    const auto camera = static_cast<size_t>(views[v].camera);
    std::vector<std::shared_ptr<const LuminanceImage>> kept(static_cast<size_t>(states));
    std::vector<const LuminanceImage*> images(kept.size());
    for (size_t i = 0; i < photos.photos.size(); ++i) {
      const RoomPhoto& photo = photos.photos[i];
      if (photo.view != views[v].view || photo.camera != views[v].camera) continue;
      const auto state = static_cast<size_t>(photo.state);
      kept[state] = photos.read(i);
      images[state] = kept[state].get();
    }
    signatures[v] = MakeSignatureView(cameras[camera], views[v].cam_from_world, images);
    signatures[v].camera = views[v].camera;
    signatures[v].pose_covariance = views[v].covariance;
    const auto log_gain = static_cast<float>(std::log(gains[camera]));
    for (float& y : signatures[v].log_luminance) y -= log_gain;
  });
  return signatures;
}

}  // namespace luxfit
