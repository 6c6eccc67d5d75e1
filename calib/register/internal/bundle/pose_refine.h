// Refines a pose of a camera from points and the rays on which it sees them.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_POSE_REFINE_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_POSE_REFINE_H_

#include <Eigen/Geometry>
#include <opencv2/core/types.hpp>
#include <vector>

namespace luxfit {

// Returns the pose that minimises the squared distances between points and rays in the plane at distance 1 in
// front of the camera, by Levenberg and Marquardt's method from `cam_from_world`. Points in metres; rays are
// x / z and y / z in the camera's frame. Returns the pose of least squares that was reached; where a point comes
// to lie in the camera's own plane, that is the start.
//
// cv::solvePnPRefineLM minimises the same, but allocates matrices in every step: searches among many tags took four
// times as long with it.
Eigen::Isometry3d RefinePose(const std::vector<cv::Point3d>& points, const std::vector<cv::Point2d>& rays,
                             const Eigen::Isometry3d& cam_from_world);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_POSE_REFINE_H_
