#include "inverse/observe/camera/photo_radiometry.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace luxfit {
namespace {

// Returns the index of the photo of a view in a state.
size_t PhotoOf(const RoomPhotos& photos, const std::string& view, int state) {
  const auto found = std::find_if(photos.photos.begin(), photos.photos.end(), [&](const RoomPhoto& photo) {
    return photo.view == view && photo.state == state;
  });
  if (found == photos.photos.end())
    throw std::invalid_argument("CorrectRadiometry: expected the photo of an observation");
  return static_cast<size_t>(found - photos.photos.begin());
}

OpenRadiometry OpenOf(const std::vector<StatedCamera>& cameras) {
  OpenRadiometry open;
  for (const StatedCamera& camera : cameras) {
    open.vignetting.push_back(camera.vignetting_is_open);
    open.response.push_back(camera.response_is_open);
    open.gain_is_stated.push_back(camera.cdm2_per_unit.has_value());
  }
  return open;
}

// Returns the gains that samples were divided by: stated ones before, estimated ones as corrections.
std::vector<AppliedGain> GainsOf(const OpenRadiometry& open, const std::vector<double>& stated,
                                 int unit_camera, const SelfCalibration& found) {
  std::vector<AppliedGain> applied;
  applied.reserve(found.camera_gains.size());
  for (size_t c = 0; c < found.camera_gains.size(); ++c) {
    const CameraGain& estimated = found.camera_gains[c];
    const auto unit = static_cast<size_t>(unit_camera), held = static_cast<size_t>(estimated.reference);
    if (stated[c] != 1) {
      applied.push_back({c, unit, stated[c], 0, true});
    } else if (estimated.sigma > 0) {
      // A camera of stated gain counts in the unit already.
      const size_t reference = open.gain_is_stated[held] ? unit : held;
      applied.push_back({c, reference, std::exp(estimated.log_gain), estimated.sigma, false});
    }
  }
  return applied;
}

std::vector<StatedVignetting> VignettingOf(const std::vector<StatedCamera>& cameras) {
  std::vector<StatedVignetting> stated;
  stated.reserve(cameras.size());
  for (const StatedCamera& camera : cameras) stated.push_back(camera.vignetting);
  return stated;
}

}  // namespace

CorrectedObservations CorrectRadiometry(const Patches& patches, const RoomPhotos& photos,
                                        const std::vector<Camera>& cameras,
                                        const std::vector<RegisteredView>& views,
                                        const std::vector<Eigen::VectorXd>& dimming,
                                        std::vector<Observation> observations) {
  if (observations.empty()) return {};
  PhotoRadiometry radiometry;
  std::vector<StatedPhoto> stated = PhotosIn(observations);
  for (StatedPhoto& photo : stated) {
    radiometry.photos.push_back(PhotoOf(photos, views.at(static_cast<size_t>(photo.view)).view, photo.state));
    photo.exposure_s = photos.photos[radiometry.photos.back()].exposure_s;
  }
  const OpenRadiometry open = OpenOf(photos.cameras);
  const std::vector<double> gains = StatedGains(photos);
  // Counts are shares of full scale by each camera's own unit.
  std::vector<PhotoSample> samples = SamplesOf(observations, stated, patches, cameras, views);
  for (PhotoSample& sample : samples) sample.log_share += std::log(gains[static_cast<size_t>(sample.camera)]);
  radiometry.found = SelfCalibrate(patches, dimming, samples, open);
  radiometry.findings = FindingsOf(radiometry.found, open, VignettingOf(photos.cameras));
  radiometry.unit_camera = UnitCamera(photos);
  radiometry.gains = GainsOf(open, gains, radiometry.unit_camera, radiometry.found);
  if (radiometry.found.is_possible)
    observations = WithCorrections(std::move(observations), samples, radiometry.found);
  return {std::move(observations), std::move(radiometry)};
}

}  // namespace luxfit
