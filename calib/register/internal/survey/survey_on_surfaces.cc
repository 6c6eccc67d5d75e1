#include "calib/register/internal/survey/survey_on_surfaces.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "calib/register/internal/bundle/survey_scale.h"
#include "calib/register/internal/survey/tag_surfaces.h"
#include "calib/register/millimetres.h"

namespace luxfit {
namespace {

constexpr double kMostSigmas = 4;  // of a tag from its surface

using Surfaces = std::map<int, SurfacePlane>;  // by tag

// Tells whether there is something to try.
bool MayTry(double given_sigma_m, const SurveyVerdict& verdict) {
  return given_sigma_m > 0 && verdict.options.survey_sigma_m > given_sigma_m &&
         verdict.options.surface.triangles.cols() > 0 && verdict.attempt.covariance.determined;
}

// Returns the surfaces on which the tags in use may hang.
Surfaces FindSurfaces(double given_sigma_m, const SurveyVerdict& verdict) {
  constexpr double kReachSigmas = 3;
  const double survey_sigma_m =
      verdict.options.survey_sigma_m * std::sqrt(verdict.attempt.covariance.variance_factor);
  TagSurfaceSearch search;
  search.reach_m = std::max(search.reach_m, kReachSigmas * survey_sigma_m);
  search.sigma_m = given_sigma_m;
  Surfaces surfaces;
  for (const int id : verdict.attempt.covariance.displaced_tags) {
    const std::optional<SurfacePlane> plane =
        SurfaceUnderTag(verdict.evidence.survey.at(id), verdict.options.surface, search);
    if (plane) surfaces[id] = *plane;
  }
  return surfaces;
}

// Registers with tags on surfaces.
SurveyVerdict RegisterOn(const Surfaces& surfaces, double given_sigma_m, SurveyVerdict verdict) {
  for (const auto& [id, plane] : surfaces) {
    SurveyedTag& tag = verdict.evidence.survey.at(id);
    tag = LaidOn(plane, tag);
  }
  verdict.evidence.surfaces = surfaces;
  verdict.attempt = RegisterBySurvey(verdict.evidence, verdict.options, {});
  SettleSurveySigma(given_sigma_m, verdict);
  return verdict;
}

// Returns how many views the attempt places.
std::ptrdiff_t PlacedViews(const SurveyAttempt& attempt) {
  if (attempt.is_refused || !attempt.adjustment.converged || !attempt.covariance.determined) return 0;
  return std::count_if(attempt.adjustment.views.begin(), attempt.adjustment.views.end(),
                       [](const BundleView& view) { return view.active; });
}

// Returns how far surfaces move the camera centres, in sigmas of the registration without them: rms per axis.
double MovedSigmas(const SurveyAttempt& without, const SurveyAttempt& with) {
  double sum = 0, count = 0;
  Eigen::Index at = 0;  // of the view's block
  for (std::size_t v = 0; v < without.adjustment.views.size(); ++v) {
    const BundleView &before = without.adjustment.views[v], &after = with.adjustment.views[v];
    if (!before.active) continue;
    if (after.active) {
      const Eigen::Vector3d moved_m = after.pose.tail<3>() - before.pose.tail<3>();
      const Eigen::Matrix3d covariance = without.covariance.of_poses.block<3, 3>(at + 3, at + 3);
      sum += moved_m.dot(covariance.ldlt().solve(moved_m));
      count += 3;
    }
    at += 6;
  }
  return std::sqrt(sum / std::max(1.0, count));
}

// Tells whether the tags that stay on surfaces outvote those that were taken off. Among many tags, a few agree
// by chance, and carry the frame away. So each one off needs two displacements more that agree, and the frame
// must stay where the survey has it.
bool AreOutvoted(int off, const SurfaceScale& scale, const SurveyAttempt& without,
                 const SurveyAttempt& with) {
  constexpr double kMostMovedSigmas = 2;  // evidence that agrees moves a pose by less than its sigma
  return off == 0 || (scale.determined >= 1 + 2 * off && MovedSigmas(without, with) <= kMostMovedSigmas);
}

// Returns the reason for which the tags do not count as lying on surfaces; empty where they do.
std::string WhyNot(int off, const SurfaceScale& scale, const SurveyAttempt& without,
                   const SurveyAttempt& with) {
  if (scale.determined < 1) return "too few tags hang on surfaces to check each other";
  if (scale.worst_sigmas > kMostSigmas || scale.IsContradicted())
    return "the tags' distances from their surfaces contradict each other (chi-square test, 99 %)";
  if (AreOutvoted(off, scale, without, with)) return "";
  return fmt::format("more than 4 sigma off their surfaces: {} tag(s), which the others cannot outvote", off);
}

// Says why they can.
std::string Why(const TagsOnSurfaces& laid, double given_sigma_m) {
  std::string agree =
      fmt::format("the tags' distances from their surfaces agree with {} (chi-square test, 99 %)",
                  Millimetres(given_sigma_m));
  if (laid.used == laid.candidates) return agree;
  return fmt::format("{}; off theirs by more than 4 sigma: {}", agree, laid.candidates - laid.used);
}

}  // namespace

TagsOnSurfaces LayTagsOnSurfaces(double given_sigma_m, SurveyVerdict& verdict) {
  TagsOnSurfaces laid;
  if (!MayTry(given_sigma_m, verdict)) return laid;
  Surfaces surfaces = FindSurfaces(given_sigma_m, verdict);
  laid.seen = static_cast<int>(verdict.attempt.covariance.displaced_tags.size());
  laid.candidates = static_cast<int>(surfaces.size());
  laid.reason = "no tag hangs near a surface that is parallel to it";
  const std::size_t fewest = (surfaces.size() + 1) / 2;
  while (!surfaces.empty()) {
    SurveyVerdict trial = RegisterOn(surfaces, given_sigma_m, verdict);
    laid.reason = "views disagree with the tags on surfaces";
    if (PlacedViews(trial.attempt) < PlacedViews(verdict.attempt)) return laid;
    const SurfaceScale scale = EstimateSurfaceScale(trial.attempt.adjustment, trial.attempt.covariance);
    if (scale.worst_sigmas > kMostSigmas && surfaces.size() > fewest) {
      surfaces.erase(scale.worst_tag);
      continue;
    }
    const auto used = static_cast<int>(surfaces.size());
    laid.reason = WhyNot(laid.candidates - used, scale, verdict.attempt, trial.attempt);
    if (!laid.reason.empty()) return laid;
    laid.used = used;
    laid.reason = Why(laid, given_sigma_m);
    verdict = std::move(trial);
    return laid;
  }
  return laid;
}

}  // namespace luxfit
