#include "apps/commands/internal/measured_photos.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "apps/commands/internal/room_run.h"
#include "apps/commands/internal/session_cameras.h"
#include "apps/export/fit_uncertainty.h"
#include "apps/export/fitted_room.h"
#include "apps/export/lux_photos.h"
#include "apps/text/suggest.h"
#include "calib/lens/camera_file.h"
#include "inverse/control/photo_glare.h"
#include "inverse/model/parameter.h"

namespace luxfit {
namespace {

bool IsRun(const std::string& input) {
  return std::filesystem::is_directory(input) || std::filesystem::path(input).filename() == "result.json";
}

// Returns the cameras as far as intrinsics are given; others have no size.
std::vector<Camera> GivenCameras(const Session& session) {
  std::vector<Camera> cameras;
  for (const SessionCamera& camera : session.cameras)
    cameras.push_back(camera.intrinsics.empty() ? Camera{} : ReadCamera(camera.intrinsics, camera.id));
  return cameras;
}

MeasuredPhotos PhotosOfSession(const MeasuredInput& input, LensNeed need, RunContext& context) {
  const Session session = ReadSession(input.input);
  if (session.photos.empty())
    throw std::runtime_error(input.input + ": photos: expected photos, got none; add [photos]");
  if (input.out.empty())
    throw std::runtime_error(
        "-o: expected the folder for the results of a session, got nothing; add -o FOLDER");
  SessionCommandOptions options;
  options.out = input.out;
  options.command_line = input.command_line;
  context = MakeContext(options, session);
  MeasuredPhotos measured;
  measured.photos = LinearizePhotos(session, context);
  if (need == LensNeed::kDirections) {
    measured.registered = CamerasWithPoses(session, measured.photos, context);
  } else {
    measured.registered.cameras = GivenCameras(session);
  }
  for (const LinearizedCamera& camera : measured.photos.cameras) {
    const std::optional<double> given = camera.Cdm2PerUnit();
    measured.scale.push_back(given ? std::optional(LuminanceScale{*given, std::nullopt}) : std::nullopt);
  }
  return measured;
}

std::optional<LuminanceScale> ScaleOfRun(const FittedPhotos& fitted) {
  if (!(fitted.camera_scale > 0)) return std::nullopt;
  const FitUncertainty uncertainty = ReadFitUncertainty(fitted.out);
  const double sigma = uncertainty.Sigma({ParameterKind::kLogCameraScale, ""});
  LuminanceScale scale{1 / fitted.camera_scale, std::nullopt};
  // A scale that the session gave was held: the fit knows nothing of its error.
  if (sigma > 0) scale.relative_sigma = std::hypot(sigma, uncertainty.relative_model_sigma);
  return scale;
}

MeasuredPhotos PhotosOfRun(const MeasuredInput& input, RunContext& context) {
  FittedPhotos fitted = ReadFittedPhotos(RunFolderOf(input.input), input.session);
  if (fitted.registered.cameras.empty())
    throw std::runtime_error(fitted.out + "/result.json: views: expected a run on photos, got none of them");
  // The stages of the run stay as they are.
  context.is_quiet = true;
  MeasuredPhotos measured;
  measured.photos = LinearizePhotos(fitted.session, context);
  context.out = std::filesystem::absolute(input.out.empty() ? fitted.out : input.out).lexically_normal();
  ExpectOwnFolders(context.out);
  context.provenance = {input.command_line, fitted.session.input_files};
  context.provenance.inputs.push_back(fitted.out + "/result.json");
  measured.scale.assign(measured.photos.cameras.size(), ScaleOfRun(fitted));
  measured.registered = std::move(fitted.registered);
  measured.corrections = ReadPhotoCorrections(fitted.out);
  return measured;
}

Camera WithOwnSize(Camera camera, const std::string& file) {
  if (camera.width_px > 0) return camera;
  const Photo photo = ReadPhoto(file);
  camera.width_px = photo.width_px();
  camera.height_px = photo.height_px();
  return camera;
}

// Returns whether one of the photo's files has this name, with or without its folders and its ending.
bool IsOfFile(const LinearizedPhoto& photo, const std::string& name) {
  const auto whole = [](const std::filesystem::path& path) {
    return std::filesystem::absolute(path).lexically_normal();
  };
  const std::filesystem::path asked(name);
  return std::any_of(photo.bracket.begin(), photo.bracket.end(), [&](const PhotoExposure& exposure) {
    const std::filesystem::path file(exposure.file);
    return asked == file.filename() || asked == file.stem() || whole(asked) == whole(file);
  });
}

}  // namespace

size_t MeasuredPhotos::IndexOf(const std::string& name, const std::string& where) const {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at != names.end()) return static_cast<size_t>(at - names.begin());
  std::vector<size_t> of_file;
  for (size_t i = 0; i < photos.photos.size(); ++i)
    if (IsOfFile(photos.photos[i], name)) of_file.push_back(i);
  if (of_file.size() == 1) return of_file.front();
  if (of_file.empty()) throw std::runtime_error(where + ": " + ExpectedOneOf(names, name));
  throw std::runtime_error(fmt::format("{}: expected a file of one photo, got one of {} and {}; name it so",
                                       where, names[of_file[0]], names[of_file[1]]));
}

const std::optional<LuminanceScale>& MeasuredPhotos::ScaleOf(size_t photo) const {
  return scale[static_cast<size_t>(photos.photos[photo].camera)];
}

Eigen::Matrix3d MeasuredPhotos::LevelFromCamera(size_t photo) const {
  const Registration& registration = registered.registration;
  const auto view =
      std::find_if(registration.views.begin(), registration.views.end(),
                   [&](const RegisteredView& v) { return v.view == photos.photos[photo].view; });
  // The frame of a tag is not level.
  if (view == registration.views.end() || registration.frame.rfind("tag ", 0) == 0) return UprightCamera();
  constexpr double kNearlyVertical = 0.98;
  const Eigen::Matrix3d world_from_cam = view->cam_from_world.linear().transpose();
  return std::abs(world_from_cam(2, 2)) < kNearlyVertical ? world_from_cam : UprightCamera();
}

LuminanceImage MeasuredPhotos::Read(size_t photo) const {
  const LinearizedPhoto& of = photos.photos[photo];
  const Camera camera = WithOwnSize(registered.cameras[static_cast<size_t>(of.camera)], of.file);
  return ReadCorrected(photos, of, camera, corrections, NoiseNeed::kOfAll);
}

MeasuredPhotos ReadMeasuredPhotos(const MeasuredInput& input, LensNeed need, RunContext& context) {
  MeasuredPhotos measured =
      IsRun(input.input) ? PhotosOfRun(input, context) : PhotosOfSession(input, need, context);
  measured.names = PhotoStems(measured.photos);
  for (std::optional<LuminanceScale>& scale : measured.scale)
    if (scale && input.scale_sigma) scale->relative_sigma = input.scale_sigma;
  return measured;
}

nlohmann::json OrNull(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

void AddNoScale(const std::string& what, RunContext& context) {
  context.AddUndetermined(
      {"scale_undetermined", what + " no absolute scale: cd/m2 are not known",
       "give cdm2_per_count_s of the camera, or name the folder of a run that a luxmeter reading scales"});
}

}  // namespace luxfit
