#include "apps/stages/calibrate/stage_calibrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/stages/calibrate/calibration_files.h"
#include "apps/stages/calibrate/calibration_images.h"
#include "apps/stages/calibrate/calibration_json.h"
#include "apps/stages/calibrate/image_grouping.h"
#include "apps/stages/calibrate/shown_board.h"
#include "apps/text/file_stem.h"
#include "apps/text/input_error.h"
#include "calib/calibrate/rig_strain.h"
#include "calib/lens/camera_file.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

using nlohmann::json;

// Share of corners that are left out where the cameras of a rig moved against each other.
constexpr double kRigOutliers = 0.1;

CalibrateCamerasOptions OptionsOf(const SessionCalibration& calibration) {
  CalibrateCamerasOptions options;
  if (calibration.lens) options.lenses = {*calibration.lens};
  if (calibration.back_end == "opencv") options.back_end = CalibrationBackEnd::kOpenCv;
  options.focal_start_px = calibration.focal_start_px;
  return options;
}

std::string Ids(const CalibrationGroup& group) {
  std::string ids;
  for (const CalibrationCamera& camera : group.input.cameras) ids += (ids.empty() ? "" : ", ") + camera.id;
  return ids;
}

bool IsBorneOut(const Calibration& rig) { return rig.converged && rig.outlier_share < kRigOutliers; }

void WarnOfStrain(const CalibrationGroup& group, const RigStrain& strain, RunContext& context) {
  if (!strain.IsStrained()) return;
  std::vector<std::string> worst;
  for (const int image : strain.worst_images)
    worst.push_back(FileName(group.input.images[static_cast<std::size_t>(image)].name));
  context.warnings.push_back(
      {"rig_strained",
       fmt::format("{}: as a rig they miss the corners by {:.3f} px, each alone by {:.3f} px; worst in {}",
                   Ids(group), strain.together_px, strain.alone_px, fmt::join(worst, " and ")),
       "take photos of a set at one moment, or hold the board still; tighten the cameras to each other; "
       "compare how photos "
       "were paired, and say it by --rig or [calibration] rig"});
}

std::vector<CalibratedGroup> Calibrate(const Session& session, const CalibrationGroup& group,
                                       RunContext& context) {
  const CalibrateCamerasOptions options = OptionsOf(session.calibration);
  Calibration calibration = CalibrateCameras(group.input, options);
  if (IsOfTags(session, group) && calibration.converged) {
    CalibrationGroup refined = WithRefinedTags(session, group, calibration.cameras.front().camera);
    calibration = CalibrateCameras(refined.input, options);
    return {{std::move(refined), std::move(calibration)}};
  }
  if (!group.is_rig) return {{group, std::move(calibration)}};
  if (IsBorneOut(calibration)) {
    WarnOfStrain(group, StrainOf(group.input, calibration, options), context);
    return {{group, std::move(calibration)}};
  }
  context.warnings.push_back(
      {"rig_rejected",
       fmt::format("{}: their images do not fit cameras fixed to each other ({}); calibrated "
                   "each for itself",
                   Ids(group),
                   calibration.converged
                       ? fmt::format("{:.0f} % of the corners left out", 100 * calibration.outlier_share)
                       : calibration.message),
       "say by --rig or [calibration] rig how images pair up: names, numbers, order or none"});
  std::vector<CalibratedGroup> alone;
  for (CalibrationGroup& single : SplitRig(group)) {
    Calibration own = CalibrateCameras(single.input, options);
    alone.push_back({std::move(single), std::move(own)});
  }
  return alone;
}

// Warns once of what is wrong with several images alike: a misspelt board makes all of them so.
void WarnOfIncompleteImages(const CalibrationGroup& group, RunContext& context) {
  constexpr std::size_t kNamed = 3;
  std::map<std::string, std::vector<std::string>> files_of_message;
  for (const auto& [image, message] : group.messages)
    files_of_message[message].push_back(FileName(group.input.images[static_cast<std::size_t>(image)].name));
  for (const auto& [message, files] : files_of_message) {
    const std::string first =
        fmt::format("{}", fmt::join(files.begin(), files.begin() + std::min(kNamed, files.size()), ", "));
    const std::string names =
        files.size() == 1 ? first
                          : fmt::format("{} of {} images ({}{})", files.size(), group.input.images.size(),
                                        first, files.size() > kNamed ? ", ..." : "");
    context.warnings.push_back({"image_incomplete", fmt::format("{}: {}", names, message),
                                "leave such images out, or photograph them again"});
  }
}

void Report(const CalibratedGroup& calibrated, RunContext& context) {
  const Calibration& c = calibrated.calibration;
  WarnOfIncompleteImages(calibrated.group, context);
  for (const CalibrationNote& note : c.notes)
    context.warnings.push_back({note.code, note.message, note.remedy, note.fails});
  for (Choice& grouping : GroupingChoices(calibrated.group)) context.choices.push_back(std::move(grouping));
  if (!c.converged) return;
  Choice choice{"lens of " + Ids(calibrated.group), ToString(c.lens), {}, c.lens_because};
  for (const LensScore& lens : c.lenses)
    choice.among.push_back(lens.is_fitted ? fmt::format("{} (held out {:.3f} px, fitted {:.3f} px)",
                                                        ToString(lens.kind), lens.held_out_px, lens.rms_px)
                                          : ToString(lens.kind) + " (" + lens.verdict + ")");
  context.choices.push_back(std::move(choice));
  if (c.board_bend_sigma_m.isZero()) return;
  const bool is_bent = !c.board_bend_m.isZero();
  context.choices.push_back(
      {"shape of the board",
       is_bent ? "bent" : "flat",
       {"flat", "bent"},
       is_bent ? fmt::format("bent by {:.3f} and {:.3f} mm in its middle, sigma {:.3f} and {:.3f}",
                             1e3 * c.board_bend_m.x(), 1e3 * c.board_bend_m.y(),
                             1e3 * c.board_bend_sigma_m.x(), 1e3 * c.board_bend_sigma_m.y())
               : "no bend above three sigma was found"});
}

// `Photo` is SessionPhoto or LinearizedPhoto.
template <typename Photo>
OwnPhotos OwnPhotosOf(const std::vector<Photo>& photos) {
  OwnPhotos own;
  for (const Photo& photo : photos) own.emplace(std::pair(photo.camera, photo.view), photo.file);
  return own;
}

std::vector<CalibratedGroup> CalibrateThese(const Session& session, const OwnPhotos& photos,
                                            const std::vector<int>& cameras, RunContext& context) {
  const StageTimer timer(context, "calibrate",
                         cameras.size() == 1 ? "one camera" : fmt::format("{} cameras", cameras.size()));
  std::vector<CalibratedGroup> calibrated;
  const std::vector<CalibrationGroup> groups = ReadCalibrationImages(session, photos, cameras);
  for (const CalibrationGroup& group : groups) ExpectBoardShown(session, group);
  for (const CalibrationGroup& group : groups) {
    for (CalibratedGroup& result : Calibrate(session, group, context)) {
      Report(result, context);
      calibrated.push_back(std::move(result));
    }
  }
  return calibrated;
}

json WriteArtifact(const Session& session, const std::vector<CalibratedGroup>& groups, RunContext& context) {
  const std::vector<std::string> files = WriteCalibrationFiles(groups, context.out);
  json artifact = ProvenanceJson("luxfit-calibrate-1", context.provenance);
  artifact["session"] = session.name;
  artifact["groups"] = json::array();
  for (const CalibratedGroup& group : groups) {
    artifact["groups"].push_back(GroupJson(group));
  }
  AddStatus(context, artifact);
  artifact["files"] = files;
  artifact["choices"] = ChoicesJson(context);
  artifact["warnings"] = WarningsJson(context);
  artifact["timing_s"] = context.timing_s;
  WriteJson(context.out + "/stages/calibrate.json", artifact);
  return artifact;
}

}  // namespace

json CalibrateSession(const Session& session, RunContext& context) {
  std::vector<int> cameras;
  for (std::size_t c = 0; c < session.cameras.size(); ++c) {
    if (CanBeCalibrated(session, session.cameras[c])) cameras.push_back(static_cast<int>(c));
  }
  if (cameras.empty())
    throw InputError(
        {session.path, 0}, "camera",
        "expected a camera with calibration_images, got none; add calibration_images = \"board/*.png\" and "
        "board = { ... } to its [[camera]]");
  return WriteArtifact(session, CalibrateThese(session, OwnPhotosOf(session.photos), cameras, context),
                       context);
}

std::vector<Camera> CamerasOf(const Session& session, const LinearizedPhotos& photos, RunContext& context) {
  std::vector<std::optional<Camera>> cameras(session.cameras.size());
  std::vector<int> unknown;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const SessionCamera& camera = session.cameras[c];
    if (camera.intrinsics.empty()) {
      unknown.push_back(static_cast<int>(c));
    } else {
      cameras[c] = ReadCamera(camera.intrinsics, camera.id);
    }
  }
  if (unknown.empty()) {
    context.choices.push_back({"lens", "as given", {}, "intrinsics were given, not estimated"});
  } else {
    const std::vector<CalibratedGroup> groups =
        CalibrateThese(session, OwnPhotosOf(photos.photos), unknown, context);
    WriteArtifact(session, groups, context);
    for (const CalibratedGroup& group : groups) {
      for (std::size_t c = 0; c < group.calibration.cameras.size(); ++c)
        cameras[static_cast<std::size_t>(group.group.cameras[c])] = group.calibration.cameras[c].camera;
      if (!group.calibration.converged)
        throw std::runtime_error(
            fmt::format("{}: camera {}: expected images that determine its intrinsics, got none; {}",
                        session.path, Ids(group.group), group.calibration.message));
    }
  }
  std::vector<Camera> known;
  known.reserve(cameras.size());
  for (const std::optional<Camera>& camera : cameras) known.push_back(*camera);
  return known;
}

}  // namespace luxfit
