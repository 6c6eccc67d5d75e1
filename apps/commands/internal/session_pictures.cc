#include "apps/commands/internal/session_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/commands/internal/session_cameras.h"
#include "apps/export/luminance_pictures.h"
#include "apps/stages/linearize/photo_store.h"

namespace luxfit {
namespace {

using nlohmann::json;

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
  context.photos = std::make_shared<PhotoStore>();
  options.decoded = context.photos;
  const RegisteredSession registered = CamerasWithPoses(session, photos, context);
  std::vector<LuminancePicture> pictures;
  {
    const StageTimer timer(context, "luminance", fmt::format("{} pictures", photos.photos.size()));
    pictures = WriteLuminancePictures(photos, registered, options);
  }
  context.photos.reset();
  WarnOfClipped(pictures, context);
  json list = json::array();
  for (const LuminancePicture& picture : pictures) list.push_back(PictureJson(picture, context.out));
  return list;
}

}  // namespace luxfit
