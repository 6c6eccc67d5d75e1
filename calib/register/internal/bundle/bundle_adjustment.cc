#include "calib/register/internal/bundle/bundle_adjustment.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>

#include "calib/luminance/median.h"
#include "calib/register/internal/bundle/bundle_problem.h"

namespace luxfit {
namespace {

constexpr double kMedianOfTwo = 1.386;  // median of chi2 with two degrees of freedom, 2 ln 2

// Returns how many active views use each point.
std::vector<int> ViewsOfPoints(const BundleAdjustment& adjustment) {
  std::vector<int> views(adjustment.points.size(), 0);
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    for (const PointObservation& seen : view.points)
      views[static_cast<std::size_t>(seen.point)] += seen.used ? 1 : 0;
  }
  return views;
}

// Holds a point's residual, and the share of its square that the fit of the point leaves: (2n - 3) / 2n for n
// views.
struct PointError {
  double squared_px = 0;
  double left = 1;
};

std::vector<PointError> PointErrors(const BundleContext& context, const BundleAdjustment& adjustment) {
  const std::vector<int> seen_by = ViewsOfPoints(adjustment);
  std::vector<PointError> errors;
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    for (const PointObservation& seen : view.points) {
      const int views = seen_by[static_cast<std::size_t>(seen.point)];
      if (!seen.used || views < 2) continue;
      errors.push_back({std::pow(PointErrorPx(context, adjustment, view, seen), 2), 1 - 1.5 / views});
    }
  }
  return errors;
}

// Sets the sigma of points. The median selects the residuals that count, and their mean square gives the
// sigma. The fit also takes 6 unknowns for each view, shared between points and corners in proportion to
// their numbers.
void RescalePoints(const BundleContext& context, BundleAdjustment& adjustment, double unknowns_of_views,
                   double corners) {
  const std::vector<PointError> errors = PointErrors(context, adjustment);
  std::vector<double> normalised;
  normalised.reserve(errors.size());
  double free = 0;
  for (const PointError& error : errors) {
    normalised.push_back(error.squared_px / error.left);
    free += 2 * error.left;
  }
  if (free <= unknowns_of_views) return;
  const double gate = kBundleRejectedSigmas * kBundleRejectedSigmas * Median(normalised) / kMedianOfTwo;
  double sum = 0, counted = 0;
  for (const PointError& error : errors) {
    if (error.squared_px > gate) continue;
    sum += error.squared_px;
    counted += 2 * error.left;
  }
  const double spare = counted * (1 - unknowns_of_views / (free + 2 * corners));
  constexpr double kLeastSigmaPx = 0.02;  // for points rendered or imported without noise
  adjustment.point_sigma_px = std::max(kLeastSigmaPx, std::sqrt(sum / std::max(1.0, spare)));
}

void RescaleCorners(const BundleContext& context, BundleAdjustment& adjustment, double unknowns_of_views,
                    double spare_of_points) {
  std::vector<double> squared;
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    for (const BundleCornerError& error : BundleViewErrors(context, adjustment, view)) {
      squared.push_back(error.sigmas * error.sigmas);
    }
  }
  adjustment.scale = adjustment.reduced_chi2 = 1;
  const double measured = 2 * static_cast<double>(squared.size());
  const double unknowns = unknowns_of_views * measured / std::max(1.0, measured + spare_of_points);
  const double spare = measured - unknowns;
  if (spare <= 0) return;
  // Corrects for the freedom that the fit takes from the residuals.
  const double correction = measured / spare;
  adjustment.scale = std::sqrt(std::max(1.0, Median(squared) / kMedianOfTwo * correction));
  double sum = 0, count = 0;
  for (const double value : squared) {
    if (value > std::pow(kBundleRejectedSigmas * adjustment.scale, 2)) continue;
    sum += value;
    count += 1;
  }
  adjustment.reduced_chi2 = std::max(1.0, sum / std::max(1.0, 2 * count - unknowns));
}

// Says why the poses did not settle, in what the user can look at: a solver's own words tell nothing of photos.
std::string UnsettledText(const BundleContext& context, const BundleAdjustment& adjustment) {
  double squares = 0, count = 0;
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    for (const BundleCornerError& error : BundleViewErrors(context, adjustment, view)) {
      if (!error.error_px.allFinite()) continue;
      squares += error.error_px.squaredNorm();
      count += 1;
    }
  }
  char rms_px[32];
  std::snprintf(rms_px, sizeof rms_px, "%.3g", std::sqrt(squares / std::max(1.0, count)));
  return std::string("the poses did not settle: ") +
         (count > 0 ? std::string("the corners of tags stay ") + rms_px + " px (RMS) off their places; "
                    : "no corner of a tag has a place in the photos; ") +
         kWhyNothingFits;
}

}  // namespace

Eigen::Isometry3d BundleView::CamFromWorld() const {
  Eigen::Isometry3d world_from_cam = Eigen::Isometry3d::Identity();
  world_from_cam.linear() = Eigen::Quaterniond(pose.head<4>()).toRotationMatrix();
  world_from_cam.translation() = pose.tail<3>();
  return world_from_cam.inverse();
}

void BundleView::SetCamFromWorld(const Eigen::Isometry3d& cam_from_world) {
  const Eigen::Isometry3d world_from_cam = cam_from_world.inverse();
  pose << Eigen::Quaterniond(world_from_cam.linear()).normalized().coeffs(), world_from_cam.translation();
}

std::vector<bool> UsedPoints(const BundleAdjustment& adjustment) {
  const std::vector<int> seen = ViewsOfPoints(adjustment);
  std::vector<bool> used(seen.size());
  std::transform(seen.begin(), seen.end(), used.begin(), [](int n) { return n >= 2; });
  return used;
}

std::array<Eigen::Vector3d, 4> AdjustedCorners(const BundleAdjustment& adjustment,
                                               const TagObservation& tag) {
  const auto found = adjustment.tags.find(tag.id);
  const BundleTag hung = found == adjustment.tags.end() ? BundleTag() : found->second;
  const Eigen::Vector3d center = TagCenter(tag);
  std::array<Eigen::Vector3d, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = center + hung.displacement_m +
                 (1 + adjustment.size_error) * (hung.turn * (tag.corners_in_world[i] - center));
  }
  return corners;
}

std::vector<BundleCornerError> BundleTagErrors(const BundleContext& context,
                                               const BundleAdjustment& adjustment, const BundleView& view,
                                               std::size_t tag_index) {
  const TagObservation& tag = view.tags[tag_index];
  const Eigen::Isometry3d cam_from_world = view.CamFromWorld();
  const std::array<Eigen::Vector3d, 4> corners = AdjustedCorners(adjustment, tag);
  std::vector<BundleCornerError> errors;
  errors.reserve(4);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d error_px =
        Project(context.CameraOf(view), cam_from_world * corners[i]) - tag.corners_px[i];
    errors.push_back({error_px, error_px.norm() / tag.sigma_px});
  }
  return errors;
}

std::vector<BundleCornerError> BundleViewErrors(const BundleContext& context,
                                                const BundleAdjustment& adjustment, const BundleView& view) {
  std::vector<BundleCornerError> errors;
  for (std::size_t i = 0; i < view.tags.size(); ++i) {
    if (!view.used[i]) continue;
    const std::vector<BundleCornerError> of_tag = BundleTagErrors(context, adjustment, view, i);
    errors.insert(errors.end(), of_tag.begin(), of_tag.end());
  }
  return errors;
}

double BundleRmsSigmas(const std::vector<BundleCornerError>& errors) {
  double sum = 0;
  for (const BundleCornerError& error : errors) sum += error.sigmas * error.sigmas;
  return errors.empty() ? 0 : std::sqrt(sum / (2 * static_cast<double>(errors.size())));
}

double PointErrorPx(const BundleContext& context, const BundleAdjustment& adjustment, const BundleView& view,
                    const PointObservation& observation) {
  const Eigen::Vector2d pixel = Project(
      context.CameraOf(view),
      view.CamFromWorld() * adjustment.points[static_cast<std::size_t>(observation.point)].p_in_world);
  return pixel.allFinite() ? (pixel - observation.pixel).norm() : std::numeric_limits<double>::infinity();
}

void RescaleBundle(const BundleContext& context, BundleAdjustment& adjustment) {
  double unknowns = 0, corners = 0, seen_points = 0;
  const std::vector<bool> used = UsedPoints(adjustment);
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    unknowns += 6;
    corners += 4 * view.TagsUsed();
    for (const PointObservation& seen : view.points)
      seen_points += seen.used && used[static_cast<std::size_t>(seen.point)] ? 1 : 0;
  }
  const double points = static_cast<double>(std::count(used.begin(), used.end(), true));
  RescaleCorners(context, adjustment, unknowns, std::max(0.0, 2 * seen_points - 3 * points));
  RescalePoints(context, adjustment, unknowns, corners);
}

void SolveBundle(const BundleContext& context, BundleAdjustment& adjustment) {
  const bool any = std::any_of(adjustment.views.begin(), adjustment.views.end(),
                               [](const BundleView& v) { return v.active; });
  if (!any) {
    adjustment.converged = false;
    adjustment.message = "no view could be registered";
    return;
  }
  const BundleProblem built = BuildBundleProblem(context, adjustment);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  if (!built.points.empty()) {
    options.linear_solver_type = ceres::SPARSE_SCHUR;
    options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (double* const point : built.points) options.linear_solver_ordering->AddElementToGroup(point, 0);
    std::vector<double*> blocks;
    built.problem->GetParameterBlocks(&blocks);
    for (double* const block : blocks) {
      if (options.linear_solver_ordering->GroupId(block) < 0)
        options.linear_solver_ordering->AddElementToGroup(block, 1);
    }
  }
  options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-8;
  options.parameter_tolerance = 1e-10;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, built.problem.get(), &summary);
  adjustment.converged = summary.termination_type == ceres::CONVERGENCE && summary.IsSolutionUsable();
  adjustment.message = adjustment.converged ? "" : UnsettledText(context, adjustment);
  adjustment.cost = summary.final_cost;
  RescaleBundle(context, adjustment);
}

}  // namespace luxfit
