// Finds the pose of a camera of known lens before a target, robust to wrong corners.
//
//   min over pose of sum rho(|w (f(pose p) - q)|^2),  rho: Cauchy's loss of the given scale (0: squares)
//
// Starts: for planar points, homographies (RANSAC) and both solutions of IPPE; for others, AP3P (RANSAC) and
// SQPNP. Each start is then refined on the pixels themselves.
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

// Holds a point of the target and the pixel that shows it.
struct SeenPoint {
  Eigen::Vector3d point;  // in the target's frame
  Eigen::Vector2d pixel;
  double weight = 1;
  // The lens of the camera that sees the point. In a rig, also its pose, where its frame is not that of the
  // pose asked for.
  const std::vector<double>* parameters = nullptr;
  Eigen::Isometry3d cam_from_rig = Eigen::Isometry3d::Identity();
};

// Returns the minimum nearest to `start` over all points that have an image, after at most `iterations`
// steps.
Eigen::Isometry3d RefinePose(const LensFunction& lens, const std::vector<SeenPoint>& points,
                             const Eigen::Isometry3d& start, double loss_scale_px, int iterations);

// Returns starts of the pose for an undistorted camera (pinhole, or plain stereographic), by the points that
// agree within `gate_px`. Empty where fewer than 4 points lie ahead or agree, or where points lie on one
// line.
std::vector<Eigen::Isometry3d> PoseStarts(const Camera& camera, const std::vector<SeenPoint>& points,
                                          double gate_px);

// Returns the sum of min(|residual|, gate)^2 over the points, px^2.
double CappedCost(const LensFunction& lens, const std::vector<SeenPoint>& points,
                  const Eigen::Isometry3d& pose, double gate_px);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_TARGET_POSE_H_
