#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/stages/linearize/linearize.h"
#include "apps/stages/observe/observed_light.h"
#include "apps/stages/observe/observed_words.h"
#include "apps/stages/observe/photo_names.h"
#include "apps/stages/session_light.h"
#include "apps/stages/stages.h"
#include "inverse/observe/evidence.h"

namespace luxfit {
namespace {

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
                    {"covered_states", NamesOf(session, place.covered_states)},
                    {"photos", place.photos},
                    {"views", place.views},
                    {"photos_without", place.missing},
                    {"at_common_height", place.is_at_common_height},
                    {"area_facing_down_m2", place.area_m2}});
  }
  return list;
}

}  // namespace

Evidence ObserveSession(const Session& session, const LinearizedPhotos& photos,
                        const RegisteredSession& registered, const Room& room, RunContext& context) {
  const std::vector<RegisteredView>& views = registered.registration.views;
  if (views.empty()) return {};
  const StageTimer timer(context, "observe",
                         fmt::format("{} photos of {} registered views", photos.photos.size(), views.size()));
  RoomPhotos given = RoomPhotosOf(session, photos);
  given.read = [&](size_t i) {
    const LinearizedPhoto& photo = photos.photos[i];
    return ReadKept(photos, photo, registered.cameras[static_cast<size_t>(photo.camera)], context);
  };
  ObserveOptions options;
  options.tags = session.tags.survey;
  options.on_photo = [&] { Advance(context, photos.photos.size()); };
  options.on_self_calibration = [&] { return std::make_shared<StageTimer>(context, "self_calibration", ""); };
  ObservedPhotos observed =
      Observe(room, given, registered.cameras, registered.registration, StateTableOf(session), options);
  const PhotoNames names = PhotoNamesOf(session, photos);
  RecordObserved(observed, given, views, names, context);
  nlohmann::json artifact = ProvenanceJson("luxfit-observe-1", context.provenance);
  artifact["photos"] = nlohmann::json::array();
  for (size_t i = 0; i < photos.photos.size(); ++i)
    artifact["photos"].push_back(
        {{"file", photos.photos[i].file}, {"elements_observed", observed.elements[i]}});
  if (observed.radiometry) AddRadiometry(*observed.radiometry, photos, names, artifact);
  artifact["seen_luminaires"] = SeenJson(session, observed.evidence.seen);
  WriteJson(context.out + "/stages/observe.json", artifact);
  return std::move(observed.evidence);
}

}  // namespace luxfit
