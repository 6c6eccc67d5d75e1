#include "apps/commands/internal/session_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/export/luminance_pictures.h"
#include "apps/stages/calibrate/calibration_images.h"
#include "apps/stages/calibrate/stage_calibrate.h"
#include "apps/stages/prepared_session.h"
#include "apps/text/input_error.h"

namespace luxfit {
namespace {

using nlohmann::json;

bool CanBeRegistered(const Session& session) {
  const bool has_tags = !session.tags.survey.empty() || session.tags.size_m > 0;
  return !session.lights && (has_tags || !session.registration.colmap_model.empty());
}

void ExpectLenses(const Session& session) {
  for (size_t c = 0; c < session.cameras.size(); ++c) {
    const SessionCamera& camera = session.cameras[c];
    if (camera.intrinsics.empty() && !CanBeCalibrated(session, camera))
      throw InputError(
          {session.path, camera.line}, fmt::format("camera[{}].intrinsics", c),
          "expected the lens, which --hdr takes out of the pictures, got none; add intrinsics = \"FILE\", "
          "or calibration_images and board");
  }
}

// Returns the session's cameras, and poses where something tells them.
RegisteredSession RegisteredOrNot(const Session& session, const LinearizedPhotos& photos,
                                  RunContext& context) {
  if (CanBeRegistered(session)) return RegisterKept(session, photos, InputsOfStages(session, ""), context);
  ExpectLenses(session);
  RegisteredSession cameras_alone;
  cameras_alone.cameras = CamerasOf(session, photos, context);
  return cameras_alone;
}

void WarnOfClipped(const std::vector<LuminancePicture>& pictures, RunContext& context) {
  const auto is_clipped = [](const LuminancePicture& picture) { return picture.saturated_share > 0; };
  const auto count = std::count_if(pictures.begin(), pictures.end(), is_clipped);
  if (count == 0) return;
  const auto worst = std::max_element(pictures.begin(), pictures.end(), [](const auto& a, const auto& b) {
    return a.saturated_share < b.saturated_share;
  });
  context.warnings.push_back(
      {"luminance_clipped",
       fmt::format(
           "{} of {} luminance pictures have saturated pixels, {} the most ({:.2f} %): their luminance is at "
           "least the one written, and glare computed from them is too low",
           count, pictures.size(), std::filesystem::path(worst->stem).filename().string(),
           100 * worst->saturated_share),
       "add shorter exposures of the same views and states to the photo table: they are merged"});
}

json PictureJson(const LuminancePicture& picture, const std::string& out) {
  const PictureView& view = picture.picture;
  constexpr double kDegrees = 180 / M_PI;
  return {{"file", std::filesystem::path(picture.stem + ".hdr").lexically_relative(out).string()},
          {"view", picture.view},
          {"state", picture.state},
          {"camera", picture.camera},
          {"is_absolute", picture.is_absolute},
          {"has_pose", picture.has_pose},
          {"projection", view.projection == PictureProjection::kPerspective ? "perspective" : "angular"},
          {"horizontal_deg", kDegrees * AngleAcross(view, view.width_px)},
          {"vertical_deg", kDegrees * AngleAcross(view, view.height_px)},
          {"saturated_share", picture.saturated_share}};
}

}  // namespace

json WriteSessionPictures(const Session& session, const LinearizedPhotos& photos, RunContext& context) {
  LuminancePictureOptions options;
  options.folder = context.out + "/luminance";
  options.command_line = context.provenance.command_line;
  for (const LinearizedCamera& camera : photos.cameras) options.cdm2_per_unit.push_back(camera.Cdm2PerUnit());
  const RegisteredSession registered = RegisteredOrNot(session, photos, context);
  std::vector<LuminancePicture> pictures;
  {
    const StageTimer timer(context, "luminance", fmt::format("{} pictures", photos.photos.size()));
    pictures = WriteLuminancePictures(photos, registered, options);
  }
  WarnOfClipped(pictures, context);
  json list = json::array();
  for (const LuminancePicture& picture : pictures) list.push_back(PictureJson(picture, context.out));
  return list;
}

}  // namespace luxfit
