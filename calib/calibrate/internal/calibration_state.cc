#include "calib/calibrate/internal/calibration_state.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "calib/lens/internal/rotation_vector.h"
#include "calib/luminance/median.h"

namespace luxfit {
namespace {

// Returns the median sigma of the corners, px.
double MedianSigmaPx(const CalibrationInput& input) {
  std::vector<double> sigmas;
  for (const CalibrationImage& image : input.images) {
    for (const BoardCorner& corner : image.corners)
      if (corner.sigma_px > 0) sigmas.push_back(corner.sigma_px);
  }
  return sigmas.empty() ? 0 : Quantile(std::move(sigmas), 0.5);
}

}  // namespace

CalibrationProblem MakeProblem(const CalibrationInput& input) {
  CalibrationProblem problem;
  problem.input = &input;
  std::map<int, int> number_of_set;
  for (const CalibrationImage& image : input.images) {
    if (!image.corners.empty()) number_of_set.emplace(image.set, 0);
  }
  for (auto& [set, number] : number_of_set) number = problem.sets++;
  const double median_px = MedianSigmaPx(input);
  for (std::size_t i = 0; i < input.images.size(); ++i) {
    const CalibrationImage& image = input.images[i];
    problem.set_of_image.push_back(image.corners.empty() ? -1 : number_of_set.at(image.set));
    for (const BoardCorner& corner : image.corners) {
      const double weight = corner.sigma_px > 0 ? median_px / corner.sigma_px : 1;
      problem.corners.push_back({static_cast<int>(i), image.camera, problem.set_of_image.back(), corner.index,
                                 corner.pixel, weight, true});
    }
  }
  std::sort(problem.corners.begin(), problem.corners.end(),
            [](const CornerObservation& a, const CornerObservation& b) {
              return std::tie(a.set, a.camera, a.point) < std::tie(b.set, b.camera, b.point);
            });
  return problem;
}

Eigen::Vector3d TargetPoint(const CalibrationTarget& target, int point, const Eigen::Vector2d& warp_m) {
  Eigen::Vector3d p = target.points[static_cast<std::size_t>(point)];
  if (!target.IsGrid()) return p;
  const int column = point % target.columns, row = point / target.columns;
  const double x = static_cast<double>(column) / (target.columns - 1);
  const double y = static_cast<double>(row) / (target.rows - 1);
  p.z() += 4 * warp_m.x() * x * (1 - x) + 4 * warp_m.y() * y * (1 - y);
  return p;
}

Eigen::Matrix2Xd Residuals(const CalibrationProblem& problem, const CalibrationState& state) {
  Eigen::Matrix2Xd residuals(2, static_cast<Eigen::Index>(problem.corners.size()));
  Eigen::Index k = 0;
  for (const CornerObservation& corner : problem.corners) {
    const auto camera = static_cast<std::size_t>(corner.camera);
    const Eigen::Vector3d p =
        state.cam_from_rig[camera] * (state.rig_from_target[static_cast<std::size_t>(corner.set)] *
                                      TargetPoint(problem.input->target, corner.point, state.warp_m));
    residuals.col(k++) =
        ProjectByLens(state.lens, state.intrinsics[camera].data(), p, false).pixel - corner.pixel;
  }
  return residuals;
}

bool IsFinite(const CalibrationState& state) {
  const auto pose_is_finite = [](const Eigen::Isometry3d& pose) { return pose.matrix().allFinite(); };
  const auto lens_is_finite = [](const std::vector<double>& parameters) {
    return std::all_of(parameters.begin(), parameters.end(), [](double p) { return std::isfinite(p); }) &&
           parameters[0] > 0 && parameters[1] > 0;
  };
  return state.warp_m.allFinite() &&
         std::all_of(state.intrinsics.begin(), state.intrinsics.end(), lens_is_finite) &&
         std::all_of(state.cam_from_rig.begin(), state.cam_from_rig.end(), pose_is_finite) &&
         std::all_of(state.rig_from_target.begin(), state.rig_from_target.end(), pose_is_finite);
}

bool SeesEveryCamera(const CalibrationProblem& problem) {
  std::vector<bool> seen(problem.input->cameras.size(), false);
  for (const CornerObservation& corner : problem.corners) {
    if (corner.used) seen[static_cast<std::size_t>(corner.camera)] = true;
  }
  return std::all_of(seen.begin(), seen.end(), [](bool s) { return s; });
}

Eigen::Matrix<double, 6, 1> RodriguesOf(const Eigen::Isometry3d& pose) {
  Eigen::Matrix<double, 6, 1> out;
  out << RotationVectorOf(pose.linear()), pose.translation();
  return out;
}

Eigen::Isometry3d PoseOf(const double* rodrigues_and_translation) {
  return PoseOf(rodrigues_and_translation, rodrigues_and_translation + 3);
}

}  // namespace luxfit
