#include "apps/stages/register/view_features.h"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "apps/stages/register/colmap_run.h"
#include "apps/stages/register/image_names.h"
#include "apps/stages/stages.h"
#include "calib/register/colmap_files.h"

namespace luxfit {
namespace {

void CheckSize(const ColmapModel& model, const ColmapImage& image, const Session& session,
               const std::vector<Camera>& cameras, int camera) {
  const Camera& theirs = model.cameras.at(image.camera);
  const Camera& ours = cameras[static_cast<std::size_t>(camera)];
  if (theirs.width_px == ours.width_px && theirs.height_px == ours.height_px) return;
  throw std::runtime_error(
      fmt::format("{}: image {}: expected a picture of {} x {} pixels as camera \"{}\" takes them, got {} x "
                  "{}; run COLMAP on the "
                  "photos themselves, neither scaled nor undistorted",
                  session.registration.colmap_model, image.name, ours.width_px, ours.height_px,
                  session.cameras[static_cast<std::size_t>(camera)].id, theirs.width_px, theirs.height_px));
}

// Combines the photos of one state and pose, each weighted by its exposure. Saturated pixels come from
// shorter exposures.
ImagePlane MergedLuminance(const LinearizedPhotos& photos, const Camera& camera,
                           const std::vector<const LinearizedPhoto*>& own, const RunContext& context) {
  ImagePlane sum, weight, brightest;
  for (const LinearizedPhoto* photo : own) {
    if (photo->state != own.front()->state) continue;
    const std::shared_ptr<const LuminanceImage> kept = ReadKept(photos, *photo, camera, context);
    const LuminanceImage& image = *kept;
    const auto exposure_s = static_cast<float>(photo->exposure_s);
    const ImagePlane part = image.saturated.select(
        ImagePlane::Zero(image.relative_luminance.rows(), image.relative_luminance.cols()),
        ImagePlane::Constant(image.relative_luminance.rows(), image.relative_luminance.cols(), exposure_s));
    if (sum.size() == 0) {
      sum = weight = ImagePlane::Zero(part.rows(), part.cols());
      brightest = image.relative_luminance;
    }
    sum += part * image.relative_luminance;
    weight += part;
    brightest = brightest.max(image.relative_luminance);
  }
  return (weight > 0).select(sum / weight, brightest);
}

}  // namespace

FeatureModel ReadFeatures(const Session& session, const LinearizedPhotos& photos,
                          const std::vector<Camera>& cameras, const ViewPhotos& views) {
  const ColmapModel model = ReadColmapModel(session.registration.colmap_model);
  std::vector<std::string> names;
  for (const auto& [id, image] : model.images) names.push_back(image.name);
  std::vector<PhotoOfView> files;
  for (const LinearizedPhoto& photo : photos.photos) files.push_back({photo.file, photo.view});
  const std::map<std::string, std::string> view_of_image =
      ViewsOfImages(names, files, session.registration.colmap_model);
  for (const auto& [id, image] : model.images) {
    const auto view = view_of_image.find(image.name);
    if (view != view_of_image.end())
      CheckSize(model, image, session, cameras, views.at(view->second).front()->camera);
  }
  if (view_of_image.empty()) {
    throw std::runtime_error(
        fmt::format("{}: expected images of the session's photos, got none of the {} ({}); name COLMAP's "
                    "images as the photos or "
                    "the views",
                    session.registration.colmap_model, model.images.size(),
                    model.images.empty() ? "an empty model" : model.images.begin()->second.name + ", ..."));
  }
  return FeaturesOf(model, view_of_image);
}

FeatureModel RunFeatures(const LinearizedPhotos& photos, const std::vector<Camera>& cameras,
                         const ViewPhotos& views, const std::vector<ViewDetections>& detections,
                         const Registration& known, const RunContext& context) {
  std::map<std::string, Eigen::Isometry3d> poses;
  for (const RegisteredView& view : known.views) poses[view.view] = view.cam_from_world;
  std::vector<ColmapPicture> pictures;
  pictures.reserve(detections.size());
  for (const ViewDetections& view : detections) {
    const Camera& camera = cameras[static_cast<std::size_t>(view.camera)];
    pictures.push_back({view.view,
                        view.camera,
                        MergedLuminance(photos, camera, views.at(view.view), context),
                        view.tags,
                        {}});
    const auto pose = poses.find(view.view);
    if (pose != poses.end()) pictures.back().cam_from_world = pose->second;
  }
  const ColmapRun run = RunColmap(pictures, cameras, context.out + "/stages/colmap");
  if (run.model_folder.empty()) return {};
  return FeaturesOf(ReadColmapModel(run.model_folder), run.view_of_image);
}

}  // namespace luxfit
