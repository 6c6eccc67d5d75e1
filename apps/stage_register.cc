#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/stage_calibrate.h"
#include "apps/stages.h"
#include "calib/luminance.h"
#include "calib/tag_refine.h"

namespace luxfit {
namespace {

// More photos of one pose average noise and outvote a corner that one of them shows badly; the pixel grid
// they share.
constexpr size_t kPhotosPerView = 6;

double DimmingSum(const Session& session, const SessionPhoto& photo) {
  for (const SessionState& state : session.states) {
    if (state.id != photo.state) continue;
    double sum = 0;
    for (const auto& [id, dimming] : state.dimming) sum += dimming;
    return sum;
  }
  return 0;
}

// Photos of each view, those with the most luminaires on first: evenly lit tags.
std::map<std::string, std::vector<const SessionPhoto*>> PhotosByView(const Session& session) {
  std::map<std::string, std::vector<const SessionPhoto*>> views;
  for (const SessionPhoto& photo : session.photos) views[photo.view].push_back(&photo);
  for (auto& [view, photos] : views) {
    std::stable_sort(photos.begin(), photos.end(), [&](const SessionPhoto* a, const SessionPhoto* b) {
      return DimmingSum(session, *a) > DimmingSum(session, *b);
    });
    photos.resize(std::min(photos.size(), kPhotosPerView));
  }
  return views;
}

std::vector<TagDetection> DetectInPhoto(const Session& session, const SessionPhoto& photo,
                                        const Camera& camera) {
  const LuminanceImage image = ReadLuminance(session, photo, camera);
  DetectTagsOptions options;
  options.family = session.tags.family;
  RefineTagCornersOptions refine;
  refine.family = session.tags.family;
  // Saturated pixels say nothing about an edge's place.
  const ImagePlane unsaturated =
      image.saturated.select(std::numeric_limits<float>::quiet_NaN(), image.relative_luminance);
  return RefineTagCorners(unsaturated, camera, DetectTags(image.relative_luminance, options), refine);
}

void WriteArtifact(const RegisteredSession& registered, const RunContext& context) {
  nlohmann::json json = ProvenanceJson("luxfit-register-1", context.provenance);
  json["converged"] = registered.registration.converged;
  json["reprojection_rms_px"] = registered.registration.reprojection_rms_px;
  json["views"] = nlohmann::json::array();
  for (const RegisteredView& view : registered.registration.views) {
    std::vector<double> matrix(12);
    Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(matrix.data()) =
        view.cam_from_world.matrix().topRows<3>();
    json["views"].push_back(
        {{"view", view.view},
         {"camera", view.camera},
         {"cam_from_world", matrix},
         {"position_sigma_m",
          {view.position_sigma_m.x(), view.position_sigma_m.y(), view.position_sigma_m.z()}},
         {"reprojection_rms_px", view.reprojection_rms_px},
         {"tags_used", view.tags_used},
         {"corners_rejected", view.corners_rejected}});
  }
  json["notes"] = nlohmann::json::array();
  for (const RegistrationNote& note : registered.registration.notes) {
    json["notes"].push_back({{"view", note.view},
                             {"tag", note.tag_id},
                             {"code", note.code},
                             {"message", note.message},
                             {"remedy", note.remedy}});
  }
  WriteJson(context.out + "/stages/register.json", json);
}

}  // namespace

RegisteredSession RegisterSession(const Session& session, RunContext& context) {
  RegisteredSession registered;
  if (session.photos.empty()) return registered;
  const auto by_view = PhotosByView(session);
  const StageTimer timer(
      context, "register",
      fmt::format("{} views, {} surveyed tags", by_view.size(), session.tags.survey.size()));
  if (session.tags.survey.empty()) {
    throw std::runtime_error(session.path +
                             ": tags.map: expected a tag map (this version registers photos by surveyed "
                             "tags), got none; add map = \"tags.json\" to [tags]");
  }
  registered.cameras = CamerasOf(session, context);
  std::vector<ViewDetections> detections;
  std::vector<std::pair<size_t, const SessionPhoto*>> jobs;
  for (const auto& [view, photos] : by_view) {
    for (const SessionPhoto* photo : photos) jobs.push_back({detections.size(), photo});
    detections.push_back({view, photos.front()->camera, {}});
  }
  std::vector<std::vector<TagDetection>> found(jobs.size());
  tbb::parallel_for(size_t{0}, jobs.size(), [&](size_t i) {
    const SessionPhoto& photo = *jobs[i].second;
    found[i] = DetectInPhoto(session, photo, registered.cameras[static_cast<size_t>(photo.camera)]);
  });
  size_t tags = 0;
  for (size_t v = 0; v < detections.size(); ++v) {
    std::vector<std::vector<TagDetection>> photos;
    for (size_t i = 0; i < jobs.size(); ++i) {
      if (jobs[i].first == v) photos.push_back(found[i]);
    }
    detections[v].tags = CombineDetections(photos);
    tags += detections[v].tags.size();
  }
  if (tags == 0) {
    throw std::runtime_error(
        fmt::format("{}: tags: expected tags of family \"{}\" in the photos, found no tag in any view; "
                    "check tags.family and that tags are at least 16 px wide, sharp and unsaturated",
                    session.path, session.tags.family));
  }
  registered.registration = RegisterViews(registered.cameras, session.tags.survey, detections);
  for (const RegistrationNote& note : registered.registration.notes) {
    context.warnings.push_back({note.code, note.message, note.remedy});
  }
  if (!registered.registration.IsUsable()) {
    throw std::runtime_error(
        fmt::format("{}: registration: expected at least one view with a pose, got none; {}", session.path,
                    registered.registration.message));
  }
  context.choices.push_back({"registration", "tags", {"tags"}, "the only method of this version"});
  WriteArtifact(registered, context);
  return registered;
}

}  // namespace luxfit
