#include "calib/register/registration.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "calib/register/internal/bundle/bundle_adjustment.h"
#include "calib/register/internal/bundle/bundle_covariance.h"
#include "calib/register/internal/feature_alignment.h"
#include "calib/register/internal/leave_out.h"
#include "calib/register/internal/survey/survey_attempt.h"
#include "calib/register/internal/survey/survey_check.h"
#include "calib/register/internal/survey/survey_on_surfaces.h"
#include "calib/register/internal/survey/tag_place.h"
#include "calib/register/internal/tag_mapping.h"
#include "calib/register/internal/tag_views.h"
#include "calib/register/millimetres.h"

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

// Adds the uncertainty of the focal lengths that the tags showed. It moves all views of a camera together.
void AddFocalUncertainty(const FocalScales& focal, const std::vector<RegisteredView>& views,
                         Eigen::MatrixXd& pose_covariance) {
  for (std::size_t c = 0; c < focal.size(); ++c) {
    if (!focal[c]) continue;
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(pose_covariance.rows());
    for (std::size_t i = 0; i < views.size(); ++i) {
      const auto its = focal[c]->pose_derivatives.find(views[i].view);
      if (views[i].camera == static_cast<int>(c) && its != focal[c]->pose_derivatives.end())
        moved.segment<6>(6 * static_cast<Eigen::Index>(i)) = focal[c]->sigma * its->second;
    }
    pose_covariance += moved * moved.transpose();
  }
}

void AddCovariances(const BundleCovariance& covariance, const FocalScales& focal,
                    Registration& registration) {
  if (registration.views.empty()) return;
  const auto rows = static_cast<Eigen::Index>(6 * registration.views.size());
  registration.pose_covariance.setConstant(rows, rows, std::numeric_limits<double>::quiet_NaN());
  if (!covariance.determined) {
    registration.converged = false;
    registration.message = "the poses are not determined: their covariance is singular";
    return;
  }
  registration.tag_size_error_sigma = covariance.size_error_sigma;
  registration.pose_covariance = covariance.of_poses;
  AddFocalUncertainty(focal, registration.views, registration.pose_covariance);
  for (std::size_t i = 0; i < registration.views.size(); ++i) {
    RegisteredView& view = registration.views[i];
    const auto at = 6 * static_cast<Eigen::Index>(i);
    view.covariance = registration.pose_covariance.block<6, 6>(at, at);
    view.position_sigma_m = view.covariance.diagonal().tail<3>().cwiseSqrt();
  }
}

void LeaveOutUncertain(double max_rotation_sigma_rad, Registration& registration) {
  std::vector<bool> is_kept;
  is_kept.reserve(registration.views.size());
  for (const RegisteredView& view : registration.views) {
    const Eigen::Matrix3d of_rotation = view.covariance.topLeftCorner<3, 3>();
    const double sigma_rad =
        of_rotation.allFinite()
            ? std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(of_rotation).eigenvalues()[2])
            : std::numeric_limits<double>::infinity();
    is_kept.push_back(sigma_rad <= max_rotation_sigma_rad);
    if (is_kept.back()) continue;
    registration.notes.push_back(
        {view.view, -1, "pose_uncertain",
         fmt::format("The tags in view {} leave its direction uncertain by {:.2g} "
                     "degrees and its place by {}; it is left out.",
                     view.view, sigma_rad * 180 / M_PI, Millimetres(view.position_sigma_m.norm())),
         "Show the view more tags, larger tags, or tags on a second surface."});
  }
  KeepViews(is_kept, registration);
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

// Notes a survey that is much less accurate than it was given.
void NameSurveySigma(double given_sigma_m, Registration& registration) {
  constexpr double kMuchLess = 2;
  if (!(registration.survey_sigma_m > kMuchLess * given_sigma_m)) return;
  const TagsOnSurfaces& on_surfaces = registration.tags_on_surfaces;
  std::string of_surfaces;
  if (on_surfaces.used > 0) {
    of_surfaces =
        fmt::format(" {} of {} tags lie on surfaces of the mesh within {}, which place the cameras.",
                    on_surfaces.used, on_surfaces.seen, Millimetres(given_sigma_m));
  } else if (!on_surfaces.reason.empty()) {
    of_surfaces = " The surfaces of the mesh do not help: " + on_surfaces.reason + ".";
  }
  registration.notes.push_back(
      {"", -1, "survey_less_accurate",
       fmt::format("The tags hang {} off their surveyed places (1 sigma per axis), not {}; the "
                   "poses' sigmas hold that.{}",
                   Millimetres(registration.survey_sigma_m), Millimetres(given_sigma_m), of_surfaces),
       "Measure the tags' places again, with a laser or along the walls, where poses should be better."});
}

void Summarise(const BundleContext& context, const BundleAdjustment& adjustment,
               const BundleCovariance& covariance, const FocalScales& focal, Registration& registration) {
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
  AddCovariances(covariance, focal, registration);
  LeaveOutUncertain(context.options.max_rotation_sigma_rad, registration);
  if (registration.views.empty() && registration.message.empty())
    registration.message = std::string("no view's tags agree with one another: ") + kWhyNothingFits;
  double total = 0, measured = 0;
  for (const RegisteredView& view : registration.views) {
    const double weight = 4 * view.tags_used + view.points_used;
    total += weight * view.reprojection_rms_px * view.reprojection_rms_px;
    measured += weight;
  }
  if (measured > 0) registration.reprojection_rms_px = std::sqrt(total / measured);
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
  AdjustViews(context, features, adjustment, registration.notes);
  Summarise(context, adjustment, ComputeBundleCovariance(context, adjustment), FocalScales(cameras.size()),
            registration);
  registration.frame = "tag " + std::to_string(map.frame_tag);
  registration.placed_tags = PlacedTags(adjustment);
  return registration;
}

// Says of the tags that disagree where the photos show them, where they do.
void SayWhereTagsHang(const BundleContext& context, const SurveyAttempt& attempt,
                      const SurveyEvidence& evidence, std::vector<RegistrationNote>& notes) {
  for (RegistrationNote& note : notes) {
    if (note.code != TagDisagrees(note.tag_id).code) continue;
    const SurveyedTag& surveyed = evidence.survey.at(note.tag_id);
    const std::optional<TagPlace> place =
        FindTagPlace(context, attempt.adjustment, attempt.covariance, surveyed, evidence.detections);
    if (!place || !place->IsOnePlace()) continue;
    const Eigen::Vector3d mm = 1000 * place->displacement_m;
    const Eigen::Vector3d at = surveyed.center_in_world + place->displacement_m;
    note.message += fmt::format(
        " The photos show it {} off its surveyed place (1 sigma: {}), by ({:.0f}, {:.0f}, {:.0f}) mm: at "
        "({:.3f}, {:.3f}, {:.3f}).",
        Millimetres(place->displacement_m.norm()), Millimetres(place->DistanceSigma()), mm.x(), mm.y(),
        mm.z(), at.x(), at.y(), at.z());
  }
}

// Registers by a survey, whose accuracy the tags themselves may contradict.
Registration RegisterWithMap(const SurveyEvidence& evidence, const RegisterViewsOptions& options,
                             const FeatureModel& features) {
  SurveyVerdict verdict = CheckSurvey(evidence, options);
  const TagsOnSurfaces on_surfaces = LayTagsOnSurfaces(options.survey_sigma_m, verdict);
  if (!features.views.empty())
    verdict.attempt = RegisterBySurvey(verdict.evidence, verdict.options, features);
  SurveyAttempt& attempt = verdict.attempt;
  Registration registration;
  registration.notes = attempt.notes;
  registration.notes.insert(registration.notes.end(), verdict.notes.begin(), verdict.notes.end());
  SayWhereTagsHang({attempt.cameras, verdict.options}, attempt, evidence, registration.notes);
  registration.survey_sigma_m = evidence.survey.empty() ? 0 : options.survey_sigma_m;
  registration.tags_on_surfaces = on_surfaces;
  if (attempt.is_refused) {
    registration.message = attempt.notes.back().message;
    return registration;
  }
  Summarise({attempt.cameras, verdict.options}, attempt.adjustment, attempt.covariance, attempt.focal,
            registration);
  if (verdict.options.survey_sigma_m > options.survey_sigma_m) {
    registration.survey_sigma_m =
        verdict.options.survey_sigma_m * std::sqrt(attempt.covariance.variance_factor);
    NameSurveySigma(options.survey_sigma_m, registration);
  }
  if (evidence.survey.empty() && registration.points > 0) registration.frame = "surface";
  return registration;
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
  return RegisterWithMap({cameras, IndexSurvey(survey), detections, {}}, options, features);
}

void KeepViews(const std::vector<bool>& is_kept, Registration& registration) {
  if (is_kept.size() != registration.views.size())
    throw std::invalid_argument("KeepViews: expected one flag for each view");
  std::vector<RegisteredView> views;
  std::vector<Eigen::Index> rows;
  views.reserve(is_kept.size());
  rows.reserve(6 * is_kept.size());
  for (std::size_t i = 0; i < is_kept.size(); ++i) {
    if (!is_kept[i]) continue;
    views.push_back(registration.views[i]);
    for (Eigen::Index k = 0; k < 6; ++k) rows.push_back(6 * static_cast<Eigen::Index>(i) + k);
  }
  registration.views = std::move(views);
  if (registration.pose_covariance.size() == 0) return;
  const Eigen::MatrixXd kept = registration.pose_covariance(rows, rows);
  registration.pose_covariance = kept;
}

}  // namespace luxfit
