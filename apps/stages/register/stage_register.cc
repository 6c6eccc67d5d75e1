#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "apps/stages/calibrate/stage_calibrate.h"
#include "apps/stages/linearize/linearize.h"
#include "apps/stages/register/choose_registration.h"
#include "apps/stages/register/registration_json.h"
#include "apps/stages/register/view_tags.h"
#include "apps/stages/stages.h"
#include "calib/luminance/luminance.h"
#include "calib/register/millimetres.h"

namespace luxfit {
namespace {

void WriteArtifact(const Session& session, const RegisteredSession& registered, const RunContext& context) {
  nlohmann::json artifact = ProvenanceJson("luxfit-register-2", context.provenance);
  artifact.update(RegistrationJson(session, registered));
  artifact["choices"] = ChoicesJson(context);
  WriteJson(context.out + "/stages/register.json", artifact);
}

// Applies focal lengths that the tags contradict: changes the cameras and records the reason.
void TakeFocalLengths(const Session& session, RegisteredSession& registered, RunContext& context) {
  const Registration& registration = registered.registration;
  for (size_t c = 0; c < registration.focal_scale.size(); ++c) {
    const double scale = registration.focal_scale[c], sigma = registration.focal_scale_sigma[c];
    if (scale == 1) continue;
    registered.cameras[c] = WithFocalScale(registered.cameras[c], scale);
    const std::string& id = session.cameras[c].id;
    const std::string found =
        fmt::format("{:.2f} +- {:.2f} % {} than its intrinsics say", 100 * std::abs(scale - 1), 100 * sigma,
                    scale > 1 ? "longer" : "shorter");
    context.choices.push_back({"focal length of " + id,
                               fmt::format("{:.1f} px", registered.cameras[c].fx_px),
                               {"as given", "estimated with the poses"},
                               "the tags agree with one that is " + found});
    context.warnings.push_back(
        {"focal_length_off",
         fmt::format("The tags show a focal length of {} that is {}; it is used.", id, found),
         "Calibrate the camera as it was focused for the photos (luxfit calibrate): its "
         "distortion may be off as well."});
  }
}

// Records the sigma of the survey with which the poses were found, and why.
void RecordSurveySigma(const Session& session, const Registration& registration, RunContext& context) {
  const double given_m = RegisterViewsOptions().survey_sigma_m;
  if (session.tags.survey.empty() || !(registration.survey_sigma_m > 0)) return;
  const bool is_larger = registration.survey_sigma_m > given_m;
  context.choices.push_back(
      {"survey sigma",
       Millimetres(registration.survey_sigma_m),
       {Millimetres(given_m) + " as given", "estimated from the tags' displacements"},
       is_larger
           ? "the tags hang further off their places than the given sigma allows, and no single moved tag "
             "explains it"
           : "the tags do not contradict it (chi-square test of their displacements, 99 %)"});
}

// Records whether the tags count as lying on the mesh's surfaces, and why.
void RecordTagsOnSurfaces(const TagsOnSurfaces& laid, RunContext& context) {
  if (laid.reason.empty()) return;
  const auto tags = [&laid](int count) { return fmt::format("{} of {}", count, laid.seen); };
  context.choices.push_back(
      {"tags on surfaces", tags(laid.used), {tags(0), "up to " + tags(laid.candidates)}, laid.reason});
}

void WarnOfMisplaced(const Session& session, const LinearizedPhotos& photos,
                     const std::vector<MisplacedPhoto>& misplaced, RunContext& context) {
  for (const MisplacedPhoto& photo : misplaced)
    context.warnings.push_back(
        {"photo_of_other_view",
         fmt::format(
             "{} shows view {}, not {}: {} of its tags lie where the other photos of {} show them, and "
             "none where those of {} do; it was not used",
             PhotoName(session, photos, photo.view, photo.state), photo.as_if_view, photo.view, photo.tags,
             photo.as_if_view, photo.view),
         fmt::format("correct its view in the photo table, or take {} in state {} again", photo.view,
                     photo.state)});
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
  for (const RegistrationNote& note : registered.registration.notes) {
    context.warnings.push_back({note.code, note.message, note.remedy});
  }
  if (!registered.registration.IsUsable()) {
    throw std::runtime_error(
        fmt::format("{}: registration: expected at least one view with a pose, got none; {}", session.path,
                    registered.registration.message));
  }
  RecordSurveySigma(session, registered.registration, context);
  RecordTagsOnSurfaces(registered.registration.tags_on_surfaces, context);
  TakeFocalLengths(session, registered, context);
  WriteArtifact(session, registered, context);
  return registered;
}

}  // namespace luxfit
