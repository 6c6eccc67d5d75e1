#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <stdexcept>

#include "apps/export/exports.h"
#include "apps/text/file_stem.h"
#include "apps/text/formats/artifact.h"
#include "calib/lens/camera_file.h"
#include "calib/register/colmap_files.h"

namespace luxfit {
namespace {

// Formats that cannot hold a lens throw; the others are written nevertheless.
void WriteWhatHolds(const std::string& path, const std::function<std::string()>& text,
                    ExportedFiles& exported) {
  try {
    WriteText(path, text());
    exported.files.push_back(path);
  } catch (const std::invalid_argument& e) {
    exported.notes.push_back(
        fmt::format("{} was left out: {}", std::filesystem::path(path).filename().string(), e.what()));
  }
}

std::vector<std::string> CameraStems(const FittedRoom& fitted) {
  std::vector<std::string> ids;
  for (const SessionCamera& camera : fitted.session.cameras) ids.push_back(camera.id);
  return DistinctFileStems(ids);
}

// Returns the file name of a photo of the view.
std::string ImageName(const Session& session, const std::string& view) {
  for (const SessionPhoto& photo : session.photos) {
    if (photo.view == view) return std::filesystem::path(photo.file).filename().string();
  }
  return view;
}

ColmapModel ModelOf(const FittedRoom& fitted) {
  ColmapModel model;
  for (size_t c = 0; c < fitted.registered.cameras.size(); ++c)
    model.cameras[static_cast<int>(c) + 1] = fitted.registered.cameras[c];
  int id = 0;
  for (const RegisteredView& view : fitted.registered.registration.views)
    model.images[++id] = {ImageName(fitted.session, view.view), view.camera + 1, view.cam_from_world, {}};
  return model;
}

}  // namespace

ExportedFiles ExportCameras(const FittedRoom& fitted, const std::string& folder) {
  ExportedFiles exported;
  if (fitted.registered.cameras.empty()) {
    exported.notes.push_back("the session has no photos: there are no cameras to export");
    return exported;
  }
  const std::vector<std::string> stems = CameraStems(fitted);
  for (size_t c = 0; c < stems.size(); ++c) {
    const Camera& camera = fitted.registered.cameras[c];
    const std::string path = folder + "/" + stems[c];
    WriteWhatHolds(
        path + ".yaml", [&] { return OpenCvCameraYaml(camera); }, exported);
    WriteWhatHolds(
        path + ".cameramodel",
        [&] {
          return MrcalCameraModel({stems[c], camera, std::nullopt});
        },
        exported);
    WriteWhatHolds(
        path + "_camchain.yaml",
        [&] {
          return KalibrCamchainYaml({{"cam0", camera, std::nullopt}});
        },
        exported);
  }
  std::vector<std::string> views;
  for (const RegisteredView& view : fitted.registered.registration.views) views.push_back(view.view);
  const std::vector<std::string> view_stems = DistinctFileStems(views);
  for (size_t v = 0; v < views.size(); ++v) {
    const RegisteredView& view = fitted.registered.registration.views[v];
    const Camera& camera = fitted.registered.cameras[static_cast<size_t>(view.camera)];
    WriteWhatHolds(
        folder + "/views/" + view_stems[v] + ".cameramodel",
        [&] {
          return MrcalCameraModel({view.view, camera, view.cam_from_world});
        },
        exported);
  }
  const ColmapModel model = ModelOf(fitted);
  WriteWhatHolds(
      folder + "/colmap/cameras.txt", [&] { return ColmapCamerasText(model.cameras); }, exported);
  WriteWhatHolds(
      folder + "/colmap/images.txt", [&] { return ColmapImagesText(model); }, exported);
  WriteWhatHolds(
      folder + "/colmap/points3D.txt", [&] { return ColmapPointsText(model); }, exported);
  return exported;
}

}  // namespace luxfit
