#include "calib/register/internal/survey/tag_place.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace luxfit {
namespace {

// Holds one view that shows the tag.
struct TagSight {
  const Camera* camera;
  Eigen::Matrix3d world_from_cam;
  Eigen::Vector3d center_m;
  const TagDetection* seen;
  Eigen::Index pose_column;  // of the covariance of poses
};

std::vector<TagSight> TagSightsOf(const BundleContext& context, const BundleAdjustment& adjustment, int id,
                                  const std::vector<ViewDetections>& detections) {
  std::vector<TagSight> sights;
  Eigen::Index column = 0;
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    const auto of_view = std::find_if(detections.begin(), detections.end(),
                                      [&](const ViewDetections& d) { return d.view == view.name; });
    const Eigen::Isometry3d world_from_cam = view.CamFromWorld().inverse();
    if (of_view != detections.end()) {
      for (const TagDetection& tag : of_view->tags) {
        if (tag.id == id)
          sights.push_back(
              {&context.CameraOf(view), world_from_cam.linear(), world_from_cam.translation(), &tag, column});
      }
    }
    column += 6;
  }
  return sights;
}

using Corners = std::array<Eigen::Vector3d, 4>;

// Returns 8 errors a view, px.
Eigen::VectorXd Errors(const std::vector<TagSight>& sights, const Corners& corners,
                       const Eigen::Vector3d& d) {
  Eigen::VectorXd errors(static_cast<Eigen::Index>(8 * sights.size()));
  Eigen::Index row = 0;
  for (const TagSight& sight : sights) {
    for (std::size_t i = 0; i < 4; ++i, row += 2) {
      errors.segment<2>(row) =
          Project(*sight.camera, sight.world_from_cam.transpose() * (corners[i] + d - sight.center_m)) -
          sight.seen->corners_px[i];
    }
  }
  return errors;
}

constexpr double kStep_m = 1e-5;  // of central differences; rad of a turn

Eigen::MatrixXd ByPlace(const std::vector<TagSight>& sights, const Corners& corners,
                        const Eigen::Vector3d& d) {
  Eigen::MatrixXd by_place(static_cast<Eigen::Index>(8 * sights.size()), 3);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = kStep_m * Eigen::Vector3d::Unit(axis);
    by_place.col(axis) =
        (Errors(sights, corners, d + step) - Errors(sights, corners, d - step)) / (2 * kStep_m);
  }
  return by_place;
}

// Returns one of the two sides of the central difference by a pose's unknown: 0 to 2 turn it about the axes of the
// world, 3 to 5 move its centre.
TagSight Stepped(TagSight sight, int unknown, double step) {
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(unknown % 3);
  if (unknown < 3) {
    sight.world_from_cam = Eigen::AngleAxisd(step, axis) * sight.world_from_cam;
  } else {
    sight.center_m += step * axis;
  }
  return sight;
}

// Returns the corners where the survey has the tag, as large as the adjustment found all tags to be printed.
Corners PrintedCorners(SurveyedTag surveyed, double size_error) {
  surveyed.size_m *= 1 + size_error;
  return TagCornersInWorld(surveyed);
}

Eigen::VectorXd BySize(const std::vector<TagSight>& sights, const SurveyedTag& surveyed, double size_error,
                       const Eigen::Vector3d& d) {
  constexpr double kStep = 1e-5;
  return (Errors(sights, PrintedCorners(surveyed, size_error + kStep), d) -
          Errors(sights, PrintedCorners(surveyed, size_error - kStep), d)) /
         (2 * kStep);
}

// Returns S of the header. `by_size`: of the errors, by the error of the printed size.
Eigen::MatrixXd ErrorCovariance(const std::vector<TagSight>& sights, const Corners& corners,
                                const Eigen::Vector3d& d, const Eigen::VectorXd& by_size,
                                const BundleCovariance& covariance) {
  const auto rows = static_cast<Eigen::Index>(8 * sights.size());
  Eigen::MatrixXd by_poses = Eigen::MatrixXd::Zero(rows, covariance.of_poses.cols());
  Eigen::MatrixXd errors = Eigen::MatrixXd::Zero(rows, rows);
  for (std::size_t s = 0; s < sights.size(); ++s) {
    const auto row = static_cast<Eigen::Index>(8 * s);
    const TagSight& sight = sights[s];
    for (int k = 0; k < 6; ++k) {
      by_poses.block<8, 1>(row, sight.pose_column + k) = (Errors({Stepped(sight, k, kStep_m)}, corners, d) -
                                                          Errors({Stepped(sight, k, -kStep_m)}, corners, d)) /
                                                         (2 * kStep_m);
    }
    const double sigma_px = sight.seen->corner_sigma_px;
    errors.diagonal().segment<8>(row).setConstant(covariance.variance_factor * sigma_px * sigma_px);
  }
  const double size_sigma = covariance.size_error_sigma;
  return errors + by_poses * covariance.of_poses * by_poses.transpose() +
         size_sigma * size_sigma * by_size * by_size.transpose();
}

// Returns where the tag is by its size alone in the view that shows it largest: near enough for the iteration.
std::optional<Eigen::Vector3d> RoughDisplacement(const std::vector<TagSight>& sights,
                                                 const SurveyedTag& surveyed, const Corners& corners) {
  const TagSight& best = *std::max_element(
      sights.begin(), sights.end(),
      [](const TagSight& a, const TagSight& b) { return a.seen->side_px < b.seen->side_px; });
  TagObservation alone{surveyed.id, surveyed.size_m,      best.seen->side_px, best.seen->corner_sigma_px,
                       corners,     best.seen->corners_px};
  for (Eigen::Vector3d& corner : alone.corners_in_world) corner -= surveyed.center_in_world;
  const std::vector<PoseCandidate> candidates = PoseCandidates(*best.camera, {alone}, {});
  if (candidates.empty()) return std::nullopt;
  return best.world_from_cam * candidates.front().cam_from_world.translation() + best.center_m -
         surveyed.center_in_world;
}

}  // namespace

double TagPlace::Sigmas(double survey_sigma_m) const {
  const Eigen::Matrix3d all = covariance_m2 + survey_sigma_m * survey_sigma_m * Eigen::Matrix3d::Identity();
  return std::sqrt(displacement_m.dot(all.ldlt().solve(displacement_m)));
}

double TagPlace::DistanceSigma() const {
  const Eigen::Vector3d direction = displacement_m.normalized();
  return std::sqrt(direction.dot(covariance_m2 * direction));
}

std::optional<TagPlace> FindTagPlace(const BundleContext& context, const BundleAdjustment& adjustment,
                                     const BundleCovariance& covariance, const SurveyedTag& surveyed,
                                     const std::vector<ViewDetections>& detections) {
  if (!covariance.determined) return std::nullopt;
  const std::vector<TagSight> sights = TagSightsOf(context, adjustment, surveyed.id, detections);
  if (sights.empty()) return std::nullopt;
  const double size_error = adjustment.size_error;
  const Corners corners = PrintedCorners(surveyed, size_error);
  std::optional<Eigen::Vector3d> d = RoughDisplacement(sights, surveyed, corners);
  constexpr int kRounds = 8;
  TagPlace place;
  for (int round = 0; d && round < kRounds; ++round) {
    const Eigen::MatrixXd by_place = ByPlace(sights, corners, *d);
    const Eigen::VectorXd errors = Errors(sights, corners, *d);
    if (!errors.allFinite() || !by_place.allFinite()) return std::nullopt;
    const Eigen::LDLT<Eigen::MatrixXd> weight(
        ErrorCovariance(sights, corners, *d, BySize(sights, surveyed, size_error, *d), covariance));
    place.covariance_m2 = (by_place.transpose() * weight.solve(by_place)).inverse();
    const Eigen::Vector3d step = place.covariance_m2 * (by_place.transpose() * weight.solve(errors));
    place.misfit = errors.dot(weight.solve(errors)) / static_cast<double>(errors.size() - 3);
    place.displacement_m = *d;
    *d -= step;
    constexpr double kSettled_m = 1e-6;
    if (step.norm() < kSettled_m) break;
  }
  if (!d || !place.covariance_m2.allFinite() || !place.displacement_m.allFinite()) return std::nullopt;
  place.views = static_cast<int>(sights.size());
  return place;
}

}  // namespace luxfit
