#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "apps/stages/linearize/camera_scale.h"
#include "apps/stages/linearize/linearize.h"
#include "apps/stages/observe/explained_photos.h"
#include "apps/stages/observe/observed_light.h"
#include "apps/stages/stages.h"
#include "apps/text/suggest.h"
#include "calib/luminance/bright_blobs.h"
#include "calib/luminance/luminance.h"
#include "inverse/observe/observe.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {
namespace {

// Returns the photo of a view with all luminaires off; null where there is none.
const LinearizedPhoto* AmbientOf(const Session& session, const LinearizedPhotos& photos,
                                 const LinearizedPhoto& photo) {
  for (const LinearizedPhoto& other : photos.photos) {
    const int state = StateIndex(session, other.state);
    if (other.view == photo.view && other.camera == photo.camera && state >= 0 &&
        IsAmbient(session, session.states[static_cast<size_t>(state)]))
      return &other;
  }
  return nullptr;
}

bool HasAmbientState(const Session& session, const LinearizedPhotos& photos) {
  return std::any_of(photos.photos.begin(), photos.photos.end(), [&](const LinearizedPhoto& photo) {
    return IsAmbient(session, session.states[static_cast<size_t>(StateIndex(session, photo.state))]);
  });
}

// Subtracts the light of the all-off state from a photo. Returns null for a photo of that state, or
// where its view has no such photo.
std::shared_ptr<const LuminanceImage> ReadLuminaireLight(const Session& session,
                                                         const LinearizedPhotos& photos,
                                                         const LinearizedPhoto& photo, const Camera& camera,
                                                         const RunContext& context) {
  const LinearizedPhoto* const ambient = AmbientOf(session, photos, photo);
  if (!ambient || ambient->state == photo.state) return nullptr;
  return std::make_shared<const LuminanceImage>(WithoutAmbient(*ReadKept(photos, photo, camera, context),
                                                               *ReadKept(photos, *ambient, camera, context)));
}

void RecordAmbient(const Session& session, const LinearizedPhotos& photos, RunContext& context) {
  context.choices.push_back(
      {"ambient light", "subtracted", {}, "photos of a state with all luminaires off are given"});
  std::vector<std::string> missing;
  for (const LinearizedPhoto& photo : photos.photos) {
    if (!AmbientOf(session, photos, photo) && std::count(missing.begin(), missing.end(), photo.view) == 0)
      missing.push_back(photo.view);
  }
  if (missing.empty()) return;
  context.warnings.push_back(
      {"ambient_missing",
       "views " + ListNames(missing) +
           " have no photo with all luminaires off: they show ambient light that cannot be "
           "subtracted, and were not used",
       "photograph these views with all luminaires off too"});
}

// Lists the blobs of all photos but those left out.
std::vector<PhotoBlobs> ListBlobs(std::vector<std::optional<PhotoBlobs>> blobs,
                                  const std::vector<PhotoAsIf>& left_out) {
  std::vector<PhotoBlobs> photos;
  for (std::optional<PhotoBlobs>& photo : blobs) {
    const auto is_of = [&](const PhotoAsIf& p) { return p.view == photo->view && p.state == photo->state; };
    if (photo && std::none_of(left_out.begin(), left_out.end(), is_of)) photos.push_back(std::move(*photo));
  }
  return photos;
}

std::vector<std::string> NamesOf(const Session& session, const std::vector<int>& states) {
  std::vector<std::string> names;
  names.reserve(states.size());
  for (const int s : states) names.push_back(session.states[static_cast<size_t>(s)].id);
  return names;
}

nlohmann::json SeenJson(const Session& session, const std::vector<SeenPlace>& places) {
  nlohmann::json list = nlohmann::json::array();
  for (const SeenPlace& place : places) {
    const Eigen::Vector3d& p = place.position;
    list.push_back({{"position_m", {p.x(), p.y(), p.z()}},
                    {"sigma_m", place.sigma_m},
                    {"states", NamesOf(session, place.states)},
                    {"dark_states", NamesOf(session, place.dark_states)},
                    {"photos", place.photos},
                    {"views", place.views},
                    {"photos_without", place.missing},
                    {"area_facing_down_m2", place.area_m2}});
  }
  return list;
}

}  // namespace

SessionObservations ObserveSession(const Session& session, const LinearizedPhotos& photos,
                                   const RegisteredSession& registered, const Room& room,
                                   RunContext& context) {
  const std::vector<RegisteredView>& views = registered.registration.views;
  if (views.empty()) return {};
  const StageTimer timer(context, "observe",
                         fmt::format("{} photos of {} registered views", photos.photos.size(), views.size()));
  std::vector<PixelDirections> directions;
  for (const Camera& camera : registered.cameras) directions.push_back(UnprojectAllPixels(camera));
  std::vector<PixelMap> maps;
  for (const RegisteredView& view : views) {
    const size_t c = static_cast<size_t>(view.camera);
    const Camera& camera = registered.cameras[c];
    maps.push_back(MapPixels(camera, directions[c], view.cam_from_world, room,
                             TagQuads(session.tags.survey, camera, view.cam_from_world)));
  }
  const bool has_ambient = HasAmbientState(session, photos);
  if (has_ambient) RecordAmbient(session, photos, context);
  std::vector<std::vector<Observation>> by_photo(photos.photos.size());
  std::vector<std::optional<PhotoBlobs>> blobs(photos.photos.size());
  tbb::parallel_for(size_t{0}, photos.photos.size(), [&](size_t i) {
    const LinearizedPhoto& photo = photos.photos[i];
    Advance(context, photos.photos.size());
    const auto view = std::find_if(views.begin(), views.end(),
                                   [&](const RegisteredView& v) { return v.view == photo.view; });
    if (view == views.end()) return;
    const Camera& camera = registered.cameras[static_cast<size_t>(photo.camera)];
    const int index = static_cast<int>(view - views.begin());
    const auto image = has_ambient ? ReadLuminaireLight(session, photos, photo, camera, context)
                                   : ReadKept(photos, photo, camera, context);
    if (!image) return;
    blobs[i] = {index, StateIndex(session, photo.state), FindBrightBlobs(*image)};
    by_photo[i] =
        ObservePhoto(maps[static_cast<size_t>(index)], *image, index, StateIndex(session, photo.state));
  });
  std::vector<Observation> observations;
  nlohmann::json artifact = ProvenanceJson("luxfit-observe-1", context.provenance);
  artifact["photos"] = nlohmann::json::array();
  for (size_t i = 0; i < by_photo.size(); ++i) {
    observations.insert(observations.end(), by_photo[i].begin(), by_photo[i].end());
    artifact["photos"].push_back(
        {{"file", photos.photos[i].file}, {"elements_observed", by_photo[i].size()}});
  }
  observations = InOneUnit(std::move(observations), photos, views);
  std::vector<PhotoAsIf> photos_as_if = FindPhotosAsIf(room.patches, observations);
  WarnOfPhotos(session, photos, registered, photos_as_if, context);
  observations = WithoutPhotos(observations, photos_as_if);
  std::vector<StateExplanation> states_as_if = ExplainStates(session, room.patches, observations, context);
  observations = WithSelfCalibration(session, photos, registered, room.patches, states_as_if,
                                     std::move(observations), context, artifact);
  const std::vector<PhotoBlobs> seen = ListBlobs(std::move(blobs), photos_as_if);
  SeenLuminairesOptions seen_options;
  seen_options.tags = session.tags.survey;
  SessionObservations observed{std::move(observations),
                               FindSeenLuminaires(room, registered.cameras, views, seen, seen_options),
                               FindSeenOutlines(registered.cameras, views, seen),
                               PoseErrorsOf(registered.registration),
                               std::move(photos_as_if),
                               std::move(states_as_if)};
  artifact["seen_luminaires"] = SeenJson(session, observed.seen);
  WriteJson(context.out + "/stages/observe.json", artifact);
  return observed;
}

}  // namespace luxfit
