#include "calib/registration.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "calib/internal/bundle_adjustment.h"
#include "calib/internal/pose_start.h"

namespace luxfit {
namespace {

constexpr double kPi = 3.14159265358979323846;

std::string Join(const std::vector<std::string>& words) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : ", ") + word;
  return joined;
}

std::map<int, SurveyedTag> IndexSurvey(const std::vector<SurveyedTag>& survey) {
  std::map<int, SurveyedTag> by_id;
  for (const SurveyedTag& tag : survey) {
    if (!by_id.emplace(tag.id, tag).second) {
      throw std::invalid_argument("RegisterViews: survey: tag " + std::to_string(tag.id) + " appears twice");
    }
    if (!(tag.size_m > 0)) {
      throw std::invalid_argument("RegisterViews: survey: tag " + std::to_string(tag.id) +
                                  ": expected size_m > 0");
    }
  }
  return by_id;
}

void CheckOptions(const RegisterViewsOptions& options) {
  if (!(options.survey_sigma_m >= 0) || !(options.tag_size_sigma >= 0) || !(options.huber_sigmas > 0) ||
      !(options.max_view_rms_sigmas > 0) || !(options.max_rotation_sigma_rad > 0)) {
    throw std::invalid_argument(
        "RegisterViews: options: expected survey_sigma_m >= 0, tag_size_sigma >= 0, huber_sigmas > 0, "
        "max_view_rms_sigmas > 0, max_rotation_sigma_rad > 0");
  }
}

BundleView ToView(const ViewDetections& detections, const std::map<int, SurveyedTag>& survey,
                  std::map<int, std::vector<std::string>>& unknown, std::vector<RegistrationNote>& notes) {
  BundleView view;
  view.name = detections.view;
  view.camera = detections.camera;
  std::map<int, int> times_seen;
  for (const TagDetection& tag : detections.tags) ++times_seen[tag.id];
  for (const auto& [id, times] : times_seen) {
    if (times < 2) continue;
    notes.push_back({view.name, id, "tag_duplicated",
                     "Tag " + std::to_string(id) + " is seen " + std::to_string(times) + " times in view " +
                         view.name + "; it is left out there.",
                     "Hang each tag id once, or remove copies and mirrors from view."});
  }
  for (const TagDetection& detection : detections.tags) {
    const auto surveyed = survey.find(detection.id);
    if (surveyed == survey.end()) {
      std::vector<std::string>& seen_in = unknown[detection.id];
      if (seen_in.empty() || seen_in.back() != view.name) seen_in.push_back(view.name);
      continue;
    }
    if (times_seen[detection.id] > 1) continue;
    if (!(detection.corner_sigma_px > 0)) {
      throw std::invalid_argument("RegisterViews: view " + view.name + ": expected corner_sigma_px > 0");
    }
    view.tags.push_back({detection.id, surveyed->second.size_m, detection.side_px, detection.corner_sigma_px,
                         TagCornersInWorld(surveyed->second), detection.corners_px});
  }
  view.used.assign(view.tags.size(), false);
  return view;
}

std::vector<TagObservation> Without(const std::vector<TagObservation>& tags, const std::set<int>& left_out) {
  std::vector<TagObservation> kept;
  for (const TagObservation& tag : tags) {
    if (left_out.count(tag.id) == 0) kept.push_back(tag);
  }
  return kept;
}

// Tags that more views contradict than confirm, each view having agreed on a pose by two tags or more.
std::set<int> FindMovedTags(const BundleContext& context, const std::vector<BundleView>& views,
                            const PoseStartOptions& start_options) {
  std::map<int, int> balance;
  for (const BundleView& view : views) {
    const PoseStart start =
        EstimatePoseStart(context.cameras[static_cast<std::size_t>(view.camera)], view.tags, start_options);
    if (start.status != PoseStartStatus::kOk ||
        std::count(start.agrees.begin(), start.agrees.end(), true) < 2)
      continue;
    for (std::size_t i = 0; i < view.tags.size(); ++i) balance[view.tags[i].id] += start.agrees[i] ? 1 : -1;
  }
  std::set<int> moved;
  for (const auto& [id, votes] : balance) {
    if (votes < 0) moved.insert(id);
  }
  return moved;
}

RegistrationNote TagDisagrees(int id) {
  return {"", id, "tag_disagrees",
          "Tag " + std::to_string(id) +
              " disagrees with the other tags in every view that can tell; it is left out.",
          "Measure its place, size and up direction again, or see whether it was moved."};
}

RegistrationNote StartNote(const BundleView& view, const PoseStart& start) {
  if (start.status == PoseStartStatus::kAmbiguous) {
    return {
        view.name, -1, "pose_ambiguous",
        "View " + view.name +
            " sees its tags so frontally or so small that two poses fit them equally well; it is left out.",
        "Show the view another tag, on another surface, or take it closer and more obliquely."};
  }
  if (start.status == PoseStartStatus::kConflict) {
    return {view.name, -1, "view_disagrees",
            "No two tags of view " + view.name + " agree on a pose; it is left out.",
            "See whether a tag was moved or its survey is wrong, and whether the camera of the view is the "
            "right one."};
  }
  return {view.name, -1, "no_tags",
          "View " + view.name + " shows no surveyed tag that can be used; it is left out.",
          "Hang a tag where the view sees it, at least 40 pixels a side, or leave the view's photos out."};
}

void StartViews(const BundleContext& context, std::vector<BundleView>& views, const std::set<int>& moved,
                std::vector<RegistrationNote>& notes) {
  PoseStartOptions start_options;
  start_options.survey_sigma_m = context.options.survey_sigma_m;
  for (BundleView& view : views) {
    view.tags = Without(view.tags, moved);
    const PoseStart start =
        EstimatePoseStart(context.cameras[static_cast<std::size_t>(view.camera)], view.tags, start_options);
    view.used = start.agrees;
    view.active = start.status == PoseStartStatus::kOk;
    if (!view.active) {
      notes.push_back(StartNote(view, start));
      continue;
    }
    const Eigen::Isometry3d world_from_cam = start.cam_from_world.inverse();
    view.world_from_cam = Eigen::Quaterniond(world_from_cam.linear()).normalized();
    view.center_in_world = world_from_cam.translation();
  }
}

// The worst tag that disagrees in every one of its views (two at least, or one where others outvote it), or
// -1.
int WorstTag(const BundleContext& context, const BundleAdjustment& adjustment) {
  struct Record {
    double least_sigmas = std::numeric_limits<double>::infinity();
    bool outvoted = true;  // every view of it has two more tags
  };
  std::map<int, Record> records;
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    const auto used = std::count(view.used.begin(), view.used.end(), true);
    for (std::size_t i = 0; i < view.tags.size(); ++i) {
      if (!view.used[i]) continue;
      Record& record = records[view.tags[i].id];
      record.least_sigmas =
          std::min(record.least_sigmas, BundleRmsSigmas(BundleTagErrors(context, adjustment, view, i)));
      record.outvoted = record.outvoted && used >= 3;
    }
  }
  int worst = -1;
  double worst_sigmas = context.options.max_view_rms_sigmas * adjustment.scale;
  for (const auto& [id, record] : records) {
    double sigmas = record.least_sigmas;
    // A displacement of the survey that its own sigma cannot explain is as telling as a bad corner.
    if (context.options.survey_sigma_m > 0) {
      sigmas = std::max(sigmas, adjustment.displacement_m.at(id).norm() / context.options.survey_sigma_m);
    }
    if (record.outvoted && sigmas > worst_sigmas) {
      worst = id;
      worst_sigmas = sigmas;
    }
  }
  return worst;
}

BundleView* WorstView(const BundleContext& context, BundleAdjustment& adjustment) {
  BundleView* worst = nullptr;
  double worst_sigmas = context.options.max_view_rms_sigmas * adjustment.scale;
  for (BundleView& view : adjustment.views) {
    if (!view.active) continue;
    const double sigmas = BundleRmsSigmas(BundleViewErrors(context, adjustment, view));
    if (sigmas > worst_sigmas) {
      worst = &view;
      worst_sigmas = sigmas;
    }
  }
  return worst;
}

// Solves, leaves out the worst tag or view, and solves again until nothing disagrees.
void SolveLeavingOut(const BundleContext& context, BundleAdjustment& adjustment,
                     std::vector<RegistrationNote>& notes) {
  while (true) {
    SolveBundle(context, adjustment);
    if (!adjustment.converged) return;
    const int tag = WorstTag(context, adjustment);
    if (tag >= 0) {
      for (BundleView& view : adjustment.views) {
        for (std::size_t i = 0; i < view.tags.size(); ++i) {
          if (view.tags[i].id == tag) view.used[i] = false;
        }
      }
      notes.push_back(TagDisagrees(tag));
      continue;
    }
    BundleView* const view = WorstView(context, adjustment);
    if (view == nullptr) return;
    std::ostringstream message;
    message.precision(2);
    message << "The corners of view " << view->name << " disagree by "
            << BundleRmsSigmas(BundleViewErrors(context, adjustment, *view))
            << " sigma (rms); it is left out.";
    notes.push_back(
        {view->name, -1, "view_disagrees", message.str(),
         "See whether the camera moved between photos of this view, and whether it is the right camera."});
    view->active = false;
  }
}

void AddCovariances(const BundleContext& context, BundleAdjustment& adjustment, Registration& registration) {
  if (registration.views.empty()) return;
  const BundleCovariance covariance = ComputeBundleCovariance(context, adjustment);
  if (!covariance.determined) {
    registration.converged = false;
    registration.message = "the poses are not determined by the tags: their covariance is singular";
    return;
  }
  registration.tag_size_error_sigma = covariance.size_error_sigma;
  for (std::size_t i = 0; i < registration.views.size(); ++i) {
    RegisteredView& view = registration.views[i];
    view.covariance = covariance.of_views[i];
    view.position_sigma_m = view.covariance.diagonal().tail<3>().cwiseSqrt();
  }
}

void LeaveOutUncertain(double max_rotation_sigma_rad, Registration& registration) {
  std::vector<RegisteredView> kept;
  for (const RegisteredView& view : registration.views) {
    const Eigen::Matrix3d of_rotation = view.covariance.topLeftCorner<3, 3>();
    const double sigma_rad =
        of_rotation.allFinite()
            ? std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(of_rotation).eigenvalues()[2])
            : std::numeric_limits<double>::infinity();
    if (sigma_rad <= max_rotation_sigma_rad) {
      kept.push_back(view);
      continue;
    }
    std::ostringstream message;
    message.precision(2);
    message << "The tags in view " << view.view << " leave its direction uncertain by "
            << sigma_rad * 180 / kPi << " degrees and its place by " << 1000 * view.position_sigma_m.norm()
            << " mm; it is left out.";
    registration.notes.push_back({view.view, -1, "pose_uncertain", message.str(),
                                  "Show the view more tags, larger tags, or tags on a second surface."});
  }
  registration.views = kept;
}

void Summarise(const BundleContext& context, BundleAdjustment& adjustment, Registration& registration) {
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    RegisteredView out;
    out.view = view.name;
    out.camera = view.camera;
    out.cam_from_world = view.CamFromWorld();
    out.covariance.setConstant(std::numeric_limits<double>::quiet_NaN());
    out.position_sigma_m.setConstant(std::numeric_limits<double>::quiet_NaN());
    out.tags_used = static_cast<int>(std::count(view.used.begin(), view.used.end(), true));
    // Tags that the starting pose already contradicted count with all their corners.
    out.corners_rejected = 4 * (static_cast<int>(view.tags.size()) - out.tags_used);
    double sum = 0;
    const std::vector<BundleCornerError> errors = BundleViewErrors(context, adjustment, view);
    for (const BundleCornerError& error : errors) {
      sum += error.error_px.squaredNorm();
      out.corners_rejected += error.sigmas > kBundleRejectedSigmas * adjustment.scale ? 1 : 0;
    }
    out.reprojection_rms_px = std::sqrt(sum / static_cast<double>(errors.size()));
    registration.views.push_back(out);
  }
  registration.converged = adjustment.converged;
  registration.message = adjustment.message;
  registration.tag_size_error = adjustment.size_error;
  AddCovariances(context, adjustment, registration);
  LeaveOutUncertain(context.options.max_rotation_sigma_rad, registration);
  double total = 0, corners = 0;
  for (const RegisteredView& view : registration.views) {
    total += 4 * view.tags_used * view.reprojection_rms_px * view.reprojection_rms_px;
    corners += 4 * view.tags_used;
  }
  if (corners > 0) registration.reprojection_rms_px = std::sqrt(total / corners);
}

}  // namespace

Registration RegisterViews(const std::vector<Camera>& cameras, const std::vector<SurveyedTag>& survey,
                           const std::vector<ViewDetections>& detections,
                           const RegisterViewsOptions& options) {
  CheckOptions(options);
  const std::map<int, SurveyedTag> survey_by_id = IndexSurvey(survey);
  const BundleContext context{cameras, options};
  Registration registration;
  BundleAdjustment adjustment;
  std::map<int, std::vector<std::string>> unknown;
  for (const ViewDetections& view : detections) {
    if (view.camera < 0 || view.camera >= static_cast<int>(cameras.size())) {
      throw std::invalid_argument("RegisterViews: view " + view.view + ": camera: expected 0 to " +
                                  std::to_string(static_cast<int>(cameras.size()) - 1) + ", got " +
                                  std::to_string(view.camera));
    }
    adjustment.views.push_back(ToView(view, survey_by_id, unknown, registration.notes));
  }
  for (const auto& [id, views] : unknown) {
    registration.notes.push_back({"", id, "tag_unknown",
                                  "Tag " + std::to_string(id) + " is seen (in " + Join(views) +
                                      ") but is not in the survey; it is left out.",
                                  "Add it to the tag survey, or take it down."});
  }

  PoseStartOptions start_options;
  start_options.survey_sigma_m = options.survey_sigma_m;
  const std::set<int> moved = FindMovedTags(context, adjustment.views, start_options);
  for (const int id : moved) registration.notes.push_back(TagDisagrees(id));
  StartViews(context, adjustment.views, moved, registration.notes);
  SolveLeavingOut(context, adjustment, registration.notes);
  Summarise(context, adjustment, registration);
  return registration;
}

}  // namespace luxfit
