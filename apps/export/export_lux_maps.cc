#include <tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "apps/export/exports.h"
#include "apps/export/lux_photos.h"
#include "apps/text/file_stem.h"

namespace luxfit {
namespace {

// Holds one photo for each view, state and camera, in their order, and the names of their files.
struct NamedPhotos {
  std::vector<const LinearizedPhoto*> photos;
  std::vector<std::string> stems;
};
NamedPhotos PhotosOf(const LinearizedPhotos& linearized) {
  NamedPhotos named;
  std::vector<std::string> names;
  for (const LinearizedPhoto& photo : linearized.photos) {
    named.photos.push_back(&photo);
    names.push_back(photo.view + "_" + photo.state);
  }
  named.stems = DistinctFileStems(names);
  return named;
}

}  // namespace

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
  const NamedPhotos named = PhotosOf(linearized);
  std::vector<std::vector<std::string>> written(named.photos.size());
  tbb::parallel_for(size_t{0}, named.photos.size(), [&](size_t i) {
    const LinearizedPhoto& photo = *named.photos[i];
    const auto view = std::find_if(views.begin(), views.end(),
                                   [&](const RegisteredView& v) { return v.view == photo.view; });
    if (view == views.end()) return;
    const Camera& camera = fitted.registered.cameras[static_cast<size_t>(photo.camera)];
    const LuminanceImage image = ReadCorrected(linearized, photo, camera, corrections);
    const PixelMap& map = seen[static_cast<size_t>(view - views.begin())].dense;
    written[i] =
        WriteLuxMap(MapIlluminance(map, image, fitted.room.patches, scale), folder + "/" + named.stems[i],
                    std::filesystem::path(photo.file).filename().string());
  });
  for (size_t i = 0; i < written.size(); ++i) {
    exported.files.insert(exported.files.end(), written[i].begin(), written[i].end());
    if (written[i].empty())
      exported.notes.push_back("no illuminance map of " + named.stems[i] + ": its view has no pose");
  }
  return exported;
}

}  // namespace luxfit
