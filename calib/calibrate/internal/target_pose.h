// Where a camera of known lens stands before a target, proof against wrong corners.
//
// Starts: planar points by homographies (RANSAC) and both solutions of IPPE; others by AP3P (RANSAC) and
// SQPNP. Each is then fitted to the pixels themselves:
//   min over pose of sum rho(|w (f(pose p) - q)|^2),  rho: Cauchy's loss of the given scale (0: squares)
//
// Source: Collins and Bartoli (2014), IPPE; Terzakis and Lourakis (2020), SQPNP; Fischler and Bolles (1981).
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_TARGET_POSE_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_TARGET_POSE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/lens/internal/lens_function.h"

namespace luxfit {

struct SeenPoint {
  Eigen::Vector3d point;  // in the target's frame
  Eigen::Vector2d pixel;
  double weight = 1;
  // Of rigs: the camera that sees it, if its frame is not the one the pose is asked for.
  const std::vector<double>* parameters = nullptr;
  Eigen::Isometry3d cam_from_rig = Eigen::Isometry3d::Identity();
};

// The nearest minimum to `start` over all points that have an image; at most `iterations` steps.
Eigen::Isometry3d RefinePose(const LensFunction& lens, const std::vector<SeenPoint>& points,
                             const Eigen::Isometry3d& start, double loss_scale_px, int iterations);

// Starts of the pose for an undistorted camera (pinhole, or plain stereographic), best last kept first by
// the number of corners within `gate_px`. Empty: fewer than 4 points have an image ahead.
std::vector<Eigen::Isometry3d> PoseStarts(const Camera& camera, const std::vector<SeenPoint>& points,
                                          double gate_px);

// sum of min(|residual|, gate)^2 over the points, px^2.
double CappedCost(const LensFunction& lens, const std::vector<SeenPoint>& points,
                  const Eigen::Isometry3d& pose, double gate_px);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_TARGET_POSE_H_
