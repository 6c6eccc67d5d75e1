#include "inverse/observe/evidence.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "calib/luminance/bright_blobs.h"
#include "calib/luminance/surround.h"
#include "inverse/observe/as_if/internal/explained_observations.h"
#include "inverse/observe/internal/ambient_photos.h"
#include "inverse/observe/internal/expect_known.h"

namespace luxfit {
namespace {

std::vector<PixelMap> MapsOfViews(const Room& room, const std::vector<Camera>& cameras,
                                  const std::vector<RegisteredView>& views,
                                  const std::vector<SurveyedTag>& tags) {
  std::vector<PixelDirections> directions;
  directions.reserve(cameras.size());
  for (const Camera& camera : cameras) directions.push_back(UnprojectAllPixels(camera));
  std::vector<PixelMap> maps;
  maps.reserve(views.size());
  for (const RegisteredView& view : views) {
    const auto c = static_cast<size_t>(view.camera);
    maps.push_back(MapPixels(cameras[c], directions[c], view.cam_from_world, room,
                             TagQuads(tags, cameras[c], view.cam_from_world)));
  }
  return maps;
}

struct SeenPhoto {
  std::vector<Observation> observations;
  std::vector<Surround::Values> surround;  // of each observation
  PictureMean mean;
  std::optional<PhotoBlobs> blobs;  // absent: the photo was not used
};

// Returns what surrounds the pixels of each observation, in the mean.
std::vector<Surround::Values> SurroundOf(const PixelMap& map, const LuminanceImage& image,
                                         const std::vector<Observation>& observations) {
  const Surround surround(image);
  std::vector<Surround::Values> sum(map.pixels_of_element.size(), Surround::Values::Zero());
  for (Eigen::Index v = 0; v < map.element.rows(); ++v) {
    for (Eigen::Index u = 0; u < map.element.cols(); ++u)
      if (map.element(v, u) >= 0) sum[static_cast<size_t>(map.element(v, u))] += surround.LogLuminance(v, u);
  }
  std::vector<Surround::Values> means;
  means.reserve(observations.size());
  for (const Observation& o : observations) {
    const auto e = static_cast<size_t>(o.element);
    means.emplace_back(sum[e] / static_cast<float>(map.pixels_of_element[e]));
  }
  return means;
}

// `ambient`: null where no photo shows ambient light alone.
std::vector<SeenPhoto> SeePhotos(const std::vector<PixelMap>& maps, const RoomPhotos& photos,
                                 const std::vector<RegisteredView>& views, const AmbientPhotos* ambient,
                                 const std::function<void()>& on_photo) {
  std::vector<SeenPhoto> seen(photos.photos.size());
  tbb::parallel_for(size_t{0}, seen.size(), [&](size_t i) {
    const RoomPhoto& photo = photos.photos[i];
    if (on_photo) on_photo();
    const auto view = ViewOf(photo, views);
    if (!view) return;
    const auto index = static_cast<int>(*view);
    if (ambient && ambient->IsDark(photo.state)) return;
    const auto image = ambient ? ambient->Read(photos, i, index) : photos.read(i);
    seen[i].blobs = {index, photo.state, FindBrightBlobs(*image)};
    seen[i].observations = ObservePhoto(maps[*view], *image, index, photo.state);
    if (ambient) seen[i].observations = ambient->Noted(seen[i].observations, photos, i);
    seen[i].surround = SurroundOf(maps[*view], *image, seen[i].observations);
    seen[i].mean = PictureMeanOf(*image);
  });
  return seen;
}

// Returns the photos that say what was counted: with ambient light taken out, luminance says no more.
CountedShares CountedSharesOf(const RoomPhotos& photos, const std::vector<RegisteredView>& views,
                              bool has_ambient) {
  CountedShares shares;
  if (photos.cameras.empty() || has_ambient) return shares;
  const std::vector<double> gains = StatedGains(photos);
  for (const RoomPhoto& photo : photos.photos) {
    const auto view = ViewOf(photo, views);
    const auto c = static_cast<size_t>(photo.camera);
    if (!view || !photos.cameras[c].response_is_open) continue;
    shares[{static_cast<int>(*view), photo.state}] = photo.exposure_s * gains[c];
  }
  return shares;
}

std::vector<int> CamerasOf(const std::vector<RegisteredView>& views) {
  std::vector<int> cameras;
  cameras.reserve(views.size());
  for (const RegisteredView& view : views) cameras.push_back(view.camera);
  return cameras;
}

// Returns the observations of all photos without the veil of their lens, and notes what was found of both. Tones
// that were mapped tell no veil.
std::vector<Observation> WithoutVeilsOf(const std::vector<SeenPhoto>& seen,
                                        const std::vector<int>& cameras_of, int cameras,
                                        ObservedPhotos& observed) {
  std::vector<Observation> observations;
  std::vector<Surround::Values> surround;
  PictureMeans means;
  for (const SeenPhoto& photo : seen) {
    surround.insert(surround.end(), photo.surround.begin(), photo.surround.end());
    observations.insert(observations.end(), photo.observations.begin(), photo.observations.end());
    observed.elements.push_back(photo.observations.size());
    if (photo.blobs) means[{photo.blobs->view, photo.blobs->state}] = photo.mean;
  }
  observed.tone_mapping = FindToneMapping(observations, surround, cameras_of, cameras);
  observed.veiling_glare = FindVeilingGlare(observations, means, cameras_of, cameras);
  for (size_t c = 0; c < observed.tone_mapping.size(); ++c)
    if (observed.tone_mapping[c] && observed.tone_mapping[c]->IsFound()) observed.veiling_glare[c].reset();
  return WithoutVeils(std::move(observations), means, cameras_of, observed.veiling_glare);
}

// Lists the blobs of all photos but those left out.
std::vector<PhotoBlobs> ListBlobs(std::vector<SeenPhoto> seen, const std::vector<PhotoAsIf>& left_out) {
  std::vector<PhotoBlobs> blobs;
  for (SeenPhoto& photo : seen) {
    const auto is_it = [&](const PhotoAsIf& p) {
      return p.view == photo.blobs->view && p.state == photo.blobs->state;
    };
    if (photo.blobs && std::none_of(left_out.begin(), left_out.end(), is_it))
      blobs.push_back(std::move(*photo.blobs));
  }
  return blobs;
}

}  // namespace

Eigen::MatrixXd PoseErrorsOf(const Registration& registration) {
  const bool is_in_doubt = registration.survey_sigma_m > 2 * RegisterViewsOptions().survey_sigma_m;
  return is_in_doubt ? registration.pose_covariance : Eigen::MatrixXd();
}

std::vector<Eigen::VectorXd> DimmingSeen(const StateTable& states,
                                         const std::vector<StateExplanation>& explained) {
  if (!explained.empty()) return explained.front().dimming;
  if (states.luminaires.empty()) return {states.states.size(), Eigen::VectorXd::Ones(1)};
  return states.dimming;
}

ObservedPhotos Observe(const Room& room, const RoomPhotos& photos, const std::vector<Camera>& cameras,
                       const Registration& registration, const StateTable& states,
                       const ObserveOptions& options) {
  ExpectKnown(photos, cameras, states);
  const std::vector<RegisteredView>& views = registration.views;
  if (views.empty()) return {};
  ObservedPhotos observed;
  Evidence& evidence = observed.evidence;
  observed.has_ambient = HasAmbient(photos, states);
  const std::vector<PixelMap> maps = MapsOfViews(room, cameras, views, options.tags);
  std::optional<AmbientPhotos> ambient;
  if (observed.has_ambient) {
    ambient.emplace(room, maps, photos, views, states);
    observed.ambient = ambient->light();
    observed.views_without_ambient = ambient->ViewsWithout(photos);
    evidence.ambient_spread = observed.ambient.spread;
  }
  std::vector<SeenPhoto> seen =
      SeePhotos(maps, photos, views, ambient ? &*ambient : nullptr, options.on_photo);
  evidence.observations = WithoutVeilsOf(seen, CamerasOf(views), static_cast<int>(cameras.size()), observed);
  {
    const std::shared_ptr<void> step = options.on_self_calibration ? options.on_self_calibration() : nullptr;
    ExplainedObservations explained = ExplainObservations(
        room.patches, InOneUnit(std::move(evidence.observations), photos, views), states,
        [&](const std::vector<Eigen::VectorXd>& dimming, const std::vector<Observation>& observations) {
          CorrectedObservations corrected =
              CorrectRadiometry(room.patches, photos, cameras, views, dimming, observations);
          observed.radiometry = std::move(corrected.radiometry);
          return std::move(corrected.observations);
        },
        CountedSharesOf(photos, views, observed.has_ambient));
    evidence.observations = std::move(explained.observations);
    evidence.photos_as_if = std::move(explained.photos_as_if);
    const bool is_mapped =
        std::any_of(observed.tone_mapping.begin(), observed.tone_mapping.end(),
                    [](const std::optional<ToneMapping>& mapping) { return mapping && mapping->IsFound(); });
    // Light adds, mapped tones do not: that is no mistake of the table.
    if (!is_mapped) evidence.states_as_if = std::move(explained.states_as_if);
  }
  const std::vector<PhotoBlobs> blobs = ListBlobs(std::move(seen), evidence.photos_as_if);
  SeenLuminairesOptions seen_options;
  seen_options.tags = options.tags;
  evidence.seen = FindSeenLuminaires(room, cameras, views, blobs, seen_options);
  evidence.outlines = FindSeenOutlines(cameras, views, blobs);
  evidence.views = WatchersOf(cameras, views, blobs);
  evidence.pose_covariance = PoseErrorsOf(registration);
  return observed;
}

}  // namespace luxfit
