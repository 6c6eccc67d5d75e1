#include "inverse/observe/camera/calibrated_observations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "calib/luminance/vignetting.h"

namespace luxfit {
namespace {

// Least relative sigma of a sample. Means of many pixels have less noise than views have in common.
constexpr double kLeastSampleSigma = 1e-4;
// Least error of ln exposure that is worth a finding.
constexpr double kWrongExposure = 0.08;
// Share of the prior's sigma above which the photos tell nothing of a state's exposures.
constexpr double kPriorAlone = 0.7;

// Returns the squared distance of a point's pixel from the image's centre over half the diagonal.
double RadiusSquared(const Camera& camera, const Eigen::Isometry3d& cam_from_world,
                     const Eigen::Vector3d& p_in_world) {
  return NoVignetting(camera.width_px, camera.height_px)
      .Radius2At(Project(camera, cam_from_world * p_in_world));
}

bool IsLoose(const SelfCalibration& found, Eigen::Index state) {
  return found.state_prior_sigma[state] != 0 &&
         !(found.state_sigma[state] < kPriorAlone * found.state_prior_sigma[state]);
}

CameraFindings FindingsOfCamera(const SelfCalibration& found, bool response_is_open,
                                StatedVignetting stated) {
  const bool darkens = found.Chosen().order > 0;
  const bool is_told = darkens || found.corner_sigma <= SelfCalibrationOptions().max_corner_sigma;
  CameraFindings findings;
  findings.darkens = darkens && stated == StatedVignetting::kNone;
  findings.is_curved = found.Chosen().exponent && response_is_open;
  findings.vignetting_is_undetermined =
      stated == StatedVignetting::kEstimate && !(found.is_possible && is_told);
  return findings;
}

}  // namespace

std::vector<StatedPhoto> PhotosIn(const std::vector<Observation>& observations) {
  std::map<std::pair<int, int>, size_t> number;
  std::vector<StatedPhoto> photos;
  for (const Observation& o : observations) {
    if (number.emplace(std::pair(o.view, o.state), photos.size()).second)
      photos.push_back({o.view, o.state, 0});
  }
  return photos;
}

std::vector<PhotoSample> SamplesOf(const std::vector<Observation>& observations,
                                   const std::vector<StatedPhoto>& photos, const Patches& patches,
                                   const std::vector<Camera>& cameras,
                                   const std::vector<RegisteredView>& views) {
  std::map<std::pair<int, int>, int> number;
  for (const StatedPhoto& photo : photos) {
    if (!(photo.exposure_s > 0)) throw std::invalid_argument("SamplesOf: expected exposures > 0");
    number.emplace(std::pair(photo.view, photo.state), static_cast<int>(number.size()));
  }
  std::vector<PhotoSample> samples;
  samples.reserve(observations.size());
  for (const Observation& o : observations) {
    const auto photo = number.find({o.view, o.state});
    if (photo == number.end()) throw std::invalid_argument("SamplesOf: expected the photo of an observation");
    const RegisteredView& view = views.at(static_cast<size_t>(o.view));
    PhotoSample sample;
    sample.element = o.element;
    sample.state = o.state;
    sample.photo = photo->second;
    sample.camera = view.camera;
    sample.radius2 = RadiusSquared(cameras.at(static_cast<size_t>(view.camera)), view.cam_from_world,
                                   patches.elements.at(static_cast<size_t>(o.element)).center);
    sample.log_value = std::log(o.relative_luminance);
    sample.log_share = sample.log_value + std::log(photos[static_cast<size_t>(sample.photo)].exposure_s);
    sample.relative_sigma = std::max(kLeastSampleSigma, std::sqrt(o.variance) / o.relative_luminance);
    samples.push_back(sample);
  }
  return samples;
}

std::vector<Observation> WithCorrections(std::vector<Observation> observations,
                                         const std::vector<PhotoSample>& samples,
                                         const SelfCalibration& found) {
  for (size_t i = 0; i < observations.size(); ++i) {
    Observation& o = observations[i];
    const PhotoSample& sample = samples.at(i);
    const double factor =
        std::exp(found.CorrectionOf(sample.photo, sample.camera).LogFactor(sample.log_share, sample.radius2));
    o.relative_luminance *= factor;
    o.relative_rgb *= factor;
    o.relative_ambient *= factor;
    o.variance = o.variance * factor * factor +
                 found.covariance(sample.photo, sample.photo) * o.relative_luminance * o.relative_luminance;
  }
  return observations;
}

RadiometryFindings FindingsOf(const SelfCalibration& found, const OpenRadiometry& open,
                              const std::vector<StatedVignetting>& stated) {
  RadiometryFindings findings;
  findings.cameras.reserve(stated.size());
  for (size_t c = 0; c < stated.size(); ++c)
    findings.cameras.push_back(FindingsOfCamera(found, open.response.at(c), stated[c]));
  for (Eigen::Index p = 0; p < found.log_gain.size(); ++p)
    if (!(std::abs(found.log_gain[p]) < kWrongExposure)) findings.wrong_photos.push_back(static_cast<int>(p));
  for (Eigen::Index s = 0; s < found.state_sigma.size() && found.Chosen().gains; ++s) {
    if (!IsLoose(found, s)) continue;
    findings.loose_states.push_back(static_cast<int>(s));
    findings.loose_sigma = std::max(findings.loose_sigma, found.state_sigma[s]);
  }
  return findings;
}

}  // namespace luxfit
