#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "apps/stages/calibrate/stage_calibrate.h"
#include "apps/stages/linearize/linearize.h"
#include "apps/stages/register/choose_registration.h"
#include "apps/stages/register/registration_json.h"
#include "apps/stages/register/registration_words.h"
#include "apps/stages/register/view_tags.h"
#include "apps/stages/stages.h"
#include "calib/luminance/luminance.h"

namespace luxfit {
namespace {

void WriteArtifact(const Session& session, const RegisteredSession& registered, const RunContext& context) {
  nlohmann::json artifact = ProvenanceJson("luxfit-register-2", context.provenance);
  artifact.update(RegistrationJson(session, registered));
  artifact["choices"] = ChoicesJson(context);
  WriteJson(context.out + "/stages/register.json", artifact);
}

void WarnOfMisplaced(const Session& session, const LinearizedPhotos& photos,
                     const std::vector<MisplacedPhoto>& misplaced, RunContext& context) {
  for (const MisplacedPhoto& photo : misplaced)
    WarnOfOtherView(PhotoName(session, photos, photo.view, photo.state), photo.view, photo.state,
                    photo.as_if_view, photo.tags, context);
}

// Takes the focal lengths that the tags show where they contradict a camera's.
std::vector<Camera> WithFocalScales(std::vector<Camera> cameras, const std::vector<double>& focal_scale) {
  for (size_t c = 0; c < focal_scale.size(); ++c) cameras[c] = WithFocalScale(cameras[c], focal_scale[c]);
  return cameras;
}

std::vector<std::string> CameraIds(const Session& session) {
  std::vector<std::string> ids;
  for (const SessionCamera& camera : session.cameras) ids.push_back(camera.id);
  return ids;
}

// Features come from the photos that remain; of a view, one at least does.
void LeaveOutMisplaced(const std::vector<MisplacedPhoto>& misplaced, ViewPhotos& views) {
  for (const MisplacedPhoto& m : misplaced) {
    std::vector<const LinearizedPhoto*>& photos = views.at(m.view);
    photos.erase(std::remove_if(photos.begin(), photos.end(),
                                [&](const LinearizedPhoto* photo) { return photo->state == m.state; }),
                 photos.end());
  }
}

}  // namespace

std::string MethodOf(const RegisteredView& view) {
  if (view.points_used == 0) return "tags";
  return view.tags_used == 0 ? "colmap" : "both";
}

RegisteredSession RegisterSession(const Session& session, const LinearizedPhotos& photos,
                                  RunContext& context) {
  RegisteredSession registered;
  if (photos.photos.empty()) return registered;
  ViewPhotos views = PhotosByView(session, photos.photos);
  const StageTimer timer(context, "register",
                         fmt::format("{} views, {} surveyed tags", views.size(), session.tags.survey.size()));
  registered.cameras = CamerasOf(session, photos, context);
  DetectedViews detected = HasTags(session) ? DetectViews(session, photos, registered.cameras, views, context)
                                            : DetectedViews{ViewsWithoutTags(views), {}};
  registered.misplaced = std::move(detected.photos);
  WarnOfMisplaced(session, photos, registered.misplaced, context);
  LeaveOutMisplaced(registered.misplaced, views);
  registered.registration =
      ChooseRegistration(session, photos, registered.cameras, views, std::move(detected.views), context);
  WarnOfNotes(registered.registration, context);
  if (!registered.registration.IsUsable()) {
    throw std::runtime_error(
        fmt::format("{}: registration: expected at least one view with a pose, got none; {}", session.path,
                    registered.registration.message));
  }
  registered.cameras = WithFocalScales(std::move(registered.cameras), registered.registration.focal_scale);
  RecordRegistration(registered.registration, registered.cameras, CameraIds(session),
                     !session.tags.survey.empty(), context);
  WriteArtifact(session, registered, context);
  return registered;
}

}  // namespace luxfit
