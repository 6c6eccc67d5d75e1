#include <tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "apps/export/exports.h"
#include "apps/export/lux_photos.h"

namespace luxfit {

ExportedFiles ExportLuxMaps(const FittedRoom& fitted, const std::string& folder, RunContext& context) {
  ExportedFiles exported;
  const std::vector<RegisteredView>& views = fitted.registered.registration.views;
  if (!(fitted.camera_scale > 0) || views.empty()) {
    exported.is_whole = false;
    exported.notes.push_back(
        "no illuminance maps: they need photos of registered views and the camera's scale, which a luxmeter "
        "reading with the role scale gives");
    return exported;
  }
  const SurfaceScale scale =
      ScaleOfSurfaces(fitted.camera_scale, SurfacesOf(fitted), ReadFitUncertainty(fitted.out));
  const PhotoCorrections corrections = ReadPhotoCorrections(fitted.out);
  const LinearizedPhotos linearized = LinearizeSession(fitted.session, context).photos;
  std::vector<PixelDirections> directions;
  for (const Camera& camera : fitted.registered.cameras) directions.push_back(UnprojectAllPixels(camera));
  std::vector<PhotoView> seen;
  seen.reserve(views.size());
  for (const RegisteredView& view : views)
    seen.push_back(
        ViewOf(fitted, view.camera, directions[static_cast<size_t>(view.camera)], view.cam_from_world));
  const std::vector<std::string> stems = PhotoStems(linearized);
  std::vector<std::vector<std::string>> written(stems.size());
  tbb::parallel_for(size_t{0}, stems.size(), [&](size_t i) {
    const LinearizedPhoto& photo = linearized.photos[i];
    const auto view = std::find_if(views.begin(), views.end(),
                                   [&](const RegisteredView& v) { return v.view == photo.view; });
    if (view == views.end()) return;
    const Camera& camera = fitted.registered.cameras[static_cast<size_t>(photo.camera)];
    const LuminanceImage image = ReadCorrected(linearized, photo, camera, corrections);
    const PixelMap& map = seen[static_cast<size_t>(view - views.begin())].dense;
    written[i] = WriteLuxMap(MapIlluminance(map, image, fitted.room.patches, scale), folder + "/" + stems[i],
                             std::filesystem::path(photo.file).filename().string());
  });
  for (size_t i = 0; i < written.size(); ++i) {
    exported.files.insert(exported.files.end(), written[i].begin(), written[i].end());
    if (written[i].empty())
      exported.notes.push_back("no illuminance map of " + stems[i] + ": its view has no pose");
  }
  return exported;
}

}  // namespace luxfit
