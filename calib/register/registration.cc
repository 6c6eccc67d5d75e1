#include "calib/register/registration.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

#include "calib/register/internal/bundle/bundle_adjustment.h"
#include "calib/register/internal/bundle/bundle_covariance.h"
#include "calib/register/internal/bundle/free_frame.h"
#include "calib/register/internal/feature_alignment.h"
#include "calib/register/internal/feature_views.h"
#include "calib/register/internal/focal_check.h"
#include "calib/register/internal/leave_out.h"
#include "calib/register/internal/survey_diagnosis.h"
#include "calib/register/internal/tag_mapping.h"
#include "calib/register/internal/tag_views.h"

namespace luxfit {
namespace {

void CheckOptions(const RegisterViewsOptions& options) {
  if (!(options.survey_sigma_m >= 0) || !(options.tag_size_sigma >= 0) || !(options.huber_sigmas > 0) ||
      !(options.max_view_rms_sigmas > 0) || !(options.tag_size_m >= 0) ||
      !(options.max_rotation_sigma_rad > 0)) {
    throw std::invalid_argument(
        "RegisterViews: options: expected survey_sigma_m >= 0, tag_size_sigma >= 0, huber_sigmas > 0, "
        "max_view_rms_sigmas > 0, max_rotation_sigma_rad > 0");
  }
}

// Holds the focal length of each camera as the tags show it; nothing: as given.
using FocalScales = std::vector<std::optional<FocalScale>>;

void AddCovariances(const BundleContext& context, BundleAdjustment& adjustment, const FocalScales& focal,
                    Registration& registration) {
  if (registration.views.empty()) return;
  const BundleCovariance covariance = ComputeBundleCovariance(context, adjustment);
  if (!covariance.determined) {
    registration.converged = false;
    registration.message = "the poses are not determined: their covariance is singular";
    return;
  }
  registration.tag_size_error_sigma = covariance.size_error_sigma;
  for (std::size_t i = 0; i < registration.views.size(); ++i) {
    RegisteredView& view = registration.views[i];
    view.covariance = covariance.of_views[i];
    if (const auto& its = focal[static_cast<std::size_t>(view.camera)]) {
      const auto moved = its->pose_derivatives.find(view.view);
      if (moved != its->pose_derivatives.end())
        view.covariance += its->sigma * its->sigma * moved->second * moved->second.transpose();
    }
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
    registration.notes.push_back(
        {view.view, -1, "pose_uncertain",
         fmt::format("The tags in view {} leave its direction uncertain by {:.2g} "
                     "degrees and its place by {:.2g} mm; it is left out.",
                     view.view, sigma_rad * 180 / M_PI, 1000 * view.position_sigma_m.norm()),
         "Show the view more tags, larger tags, or tags on a second surface."});
  }
  registration.views = kept;
}

RegisteredView ViewOf(const BundleContext& context, const BundleAdjustment& adjustment,
                      const std::vector<bool>& used_points, const BundleView& view) {
  RegisteredView out;
  out.view = view.name;
  out.camera = view.camera;
  out.cam_from_world = view.CamFromWorld();
  out.covariance.setConstant(std::numeric_limits<double>::quiet_NaN());
  out.position_sigma_m.setConstant(std::numeric_limits<double>::quiet_NaN());
  out.tags_used = view.TagsUsed();
  // Tags that the starting pose already contradicted count with all their corners.
  out.corners_rejected = 4 * (static_cast<int>(view.tags.size()) - out.tags_used);
  double sum = 0;
  for (const PointObservation& seen : view.points) {
    if (!seen.used || !used_points[static_cast<std::size_t>(seen.point)]) continue;
    ++out.points_used;
    sum += std::pow(PointErrorPx(context, adjustment, view, seen), 2);
  }
  for (const BundleCornerError& error : BundleViewErrors(context, adjustment, view)) {
    sum += error.error_px.squaredNorm();
    out.corners_rejected += error.sigmas > kBundleRejectedSigmas * adjustment.scale ? 1 : 0;
  }
  out.reprojection_rms_px = std::sqrt(sum / std::max(1, 4 * out.tags_used + out.points_used));
  return out;
}

// Notes sizes that are off by more than printers are.
void NameSizeError(const RegisterViewsOptions& options, Registration& registration) {
  constexpr double kSigmas = 4;
  if (options.tag_size_sigma == 0 || std::abs(registration.tag_size_error) < kSigmas * options.tag_size_sigma)
    return;
  registration.notes.push_back(
      {"", -1, "tag_sizes_wrong",
       fmt::format("All tags come out {:.3g} % {} than surveyed.",
                   100 * std::abs(registration.tag_size_error),
                   registration.tag_size_error > 0 ? "larger" : "smaller"),
       "Measure a printed tag's black square and the distance between two tags again."});
}

void SetFocalScales(const FocalScales& focal, Registration& registration) {
  for (std::size_t c = 0; c < focal.size(); ++c) {
    registration.focal_scale.push_back(focal[c] ? focal[c]->scale : 1);
    registration.focal_scale_sigma.push_back(focal[c] ? focal[c]->sigma : 0);
  }
}

void Summarise(const BundleContext& context, BundleAdjustment& adjustment, const FocalScales& focal,
               Registration& registration) {
  const std::vector<bool> used_points = UsedPoints(adjustment);
  for (const BundleView& view : adjustment.views) {
    if (view.active) registration.views.push_back(ViewOf(context, adjustment, used_points, view));
  }
  registration.converged = adjustment.converged;
  registration.message = adjustment.message;
  registration.tag_size_error = adjustment.size_error;
  NameSizeError(context.options, registration);
  SetFocalScales(focal, registration);
  registration.points = static_cast<int>(std::count(used_points.begin(), used_points.end(), true));
  registration.point_sigma_px = registration.points > 0 ? adjustment.point_sigma_px : 0;
  AddCovariances(context, adjustment, focal, registration);
  LeaveOutUncertain(context.options.max_rotation_sigma_rad, registration);
  double total = 0, measured = 0;
  for (const RegisteredView& view : registration.views) {
    const double weight = 4 * view.tags_used + view.points_used;
    total += weight * view.reprojection_rms_px * view.reprojection_rms_px;
    measured += weight;
  }
  if (measured > 0) registration.reprojection_rms_px = std::sqrt(total / measured);
}

// Adjusts all views, from views that have been started.
void Adjust(const BundleContext& context, const FeatureModel& features, BundleAdjustment& adjustment,
            std::vector<RegistrationNote>& notes) {
  if (!features.views.empty()) JoinFeatures(context, features, adjustment, notes);
  SolveLeavingOut(context, adjustment, notes);
  if (adjustment.fixed_tag >= 0) SettleFrame(adjustment);
}

// Returns the places of the tags after the adjustment, for those that a registered view uses.
std::vector<SurveyedTag> PlacedTags(const BundleAdjustment& adjustment) {
  std::map<int, SurveyedTag> placed;
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    for (std::size_t i = 0; i < view.tags.size(); ++i) {
      if (view.used[i])
        placed[view.tags[i].id] = TagOfCorners(view.tags[i].id, AdjustedCorners(adjustment, view.tags[i]));
    }
  }
  std::vector<SurveyedTag> tags;
  tags.reserve(placed.size());
  for (const auto& [id, tag] : placed) tags.push_back(tag);
  return tags;
}

// Starts the views: those that made the map keep their poses there, the others start as with a survey.
void StartFromMap(const BundleContext& context, const TagMap& map, std::vector<BundleView>& views,
                  std::vector<RegistrationNote>& notes) {
  StartViews(context, views, notes);
  for (BundleView& view : views) {
    const auto pose = map.cam_from_world.find(view.name);
    if (pose == map.cam_from_world.end()) continue;
    view.active = true;
    view.used = AgreeingTags(context, view, pose->second);
    view.SetCamFromWorld(pose->second);
    DropStartNotes(view.name, notes);
  }
}

Registration RegisterWithoutMap(const std::vector<Camera>& cameras, RegisterViewsOptions options,
                                const std::vector<ViewDetections>& detections, const FeatureModel& features) {
  options.survey_sigma_m = 0.02;  // error of the first map; tags are free from there
  const BundleContext context{cameras, options};
  Registration registration;
  const TagMap map = MapTags(context, detections, features);
  if (map.frame_tag < 0) {
    registration.message = "no view tells the pose of any tag";
    return registration;
  }
  BundleAdjustment adjustment;
  adjustment.fixed_tag = map.frame_tag;
  adjustment.views = ViewsOf(context, IndexSurvey(map.tags), OnlyPlaced(map, detections, registration.notes),
                             registration.notes);
  StartFromMap(context, map, adjustment.views, registration.notes);
  Adjust(context, features, adjustment, registration.notes);
  Summarise(context, adjustment, FocalScales(cameras.size()), registration);
  registration.frame = "tag " + std::to_string(map.frame_tag);
  registration.placed_tags = PlacedTags(adjustment);
  return registration;
}

// Holds one registration with the cameras as they are at the time.
struct Attempt {
  BundleAdjustment adjustment;
  std::vector<RegistrationNote> notes;
  bool is_refused = false;  // the survey is contradicted as a whole; the last note says how
};

Attempt RegisterBySurvey(const BundleContext& context, const std::map<int, SurveyedTag>& survey,
                         const std::vector<ViewDetections>& detections, const FeatureModel& features) {
  Attempt attempt;
  attempt.adjustment.views = ViewsOf(context, survey, detections, attempt.notes);
  if (const std::optional<RegistrationNote> diagnosis =
          DiagnoseSurvey(context, survey, attempt.adjustment.views)) {
    attempt.notes.push_back(*diagnosis);
    attempt.is_refused = true;
    return attempt;
  }
  StartViews(context, attempt.adjustment.views, attempt.notes);
  Adjust(context, features, attempt.adjustment, attempt.notes);
  return attempt;
}

// Corrects the focal lengths that the attempt's tags contradict, or that earlier ones did. Returns whether
// any changed. `focal` is relative to the cameras as given.
bool Refocus(const BundleContext& context, const BundleAdjustment& solved, std::vector<Camera>& cameras,
             FocalScales& focal) {
  bool is_changed = false;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    std::optional<FocalScale> its = EstimateFocalScale(context, solved, static_cast<int>(c));
    if (!its || (!its->IsOff() && !focal[c])) continue;
    if (std::abs(its->scale - 1) < its->sigma / 2) its->scale = 1;
    is_changed = is_changed || its->scale != 1;
    cameras[c] = WithFocalScale(cameras[c], its->scale);
    if (focal[c]) its->scale *= focal[c]->scale;
    focal[c] = its;
  }
  return is_changed;
}

// Corrects focal lengths so far off that the survey's tags do not agree at all.
void RefocusRoughly(const std::map<int, SurveyedTag>& survey, const std::vector<ViewDetections>& detections,
                    const RegisterViewsOptions& options, std::vector<Camera>& cameras, FocalScales& focal) {
  const BundleContext context{cameras, options};
  std::vector<RegistrationNote> said_later;
  const std::vector<BundleView> views = ViewsOf(context, survey, detections, said_later);
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const double scale = FindFocalScale(context, views, static_cast<int>(c));
    if (scale == 1) continue;
    cameras[c] = WithFocalScale(cameras[c], scale);
    constexpr double kGridSigma = 0.05;
    focal[c] = FocalScale{scale, kGridSigma, {}};
  }
}

}  // namespace

Registration RegisterViews(const std::vector<Camera>& cameras, const std::vector<SurveyedTag>& survey,
                           const std::vector<ViewDetections>& detections,
                           const RegisterViewsOptions& options) {
  return RegisterViews(cameras, survey, detections, FeatureModel(), options);
}

Registration RegisterViews(const std::vector<Camera>& cameras, const std::vector<SurveyedTag>& survey,
                           const std::vector<ViewDetections>& detections, const FeatureModel& features,
                           const RegisterViewsOptions& options) {
  CheckOptions(options);
  if (survey.empty() && options.tag_size_m > 0)
    return RegisterWithoutMap(cameras, options, detections, features);
  const std::map<int, SurveyedTag> survey_by_id = IndexSurvey(survey);
  std::vector<Camera> focused = cameras;
  FocalScales focal(cameras.size());
  RefocusRoughly(survey_by_id, detections, options, focused, focal);
  const BundleContext with_focus{focused, options};
  Attempt attempt = RegisterBySurvey(with_focus, survey_by_id, detections, features);
  constexpr int kMostRounds = 4;
  for (int round = 0; round < kMostRounds; ++round) {
    if (attempt.is_refused || !Refocus(with_focus, attempt.adjustment, focused, focal)) break;
    attempt = RegisterBySurvey(with_focus, survey_by_id, detections, features);
  }
  Registration registration;
  registration.notes = attempt.notes;
  if (attempt.is_refused) {
    registration.message = attempt.notes.back().message;
    return registration;
  }
  Summarise(with_focus, attempt.adjustment, focal, registration);
  if (survey.empty() && registration.points > 0) registration.frame = "surface";
  return registration;
}

}  // namespace luxfit
