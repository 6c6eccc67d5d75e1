// Fits, applies and differentiates plane-to-plane perspective maps.
//
//   (x', y', w)^T = H (x, y, 1)^T,  pixel = (x' / w, y' / w)
//
// Source: Hartley (1997), "In defense of the eight-point algorithm" (normalisation); Hartley and Zisserman
// (2004), "Multiple View Geometry", section 4.1 (direct linear transform).
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_HOMOGRAPHY_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_HOMOGRAPHY_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace luxfit {

// Fits H by least squares to at least four correspondences from -> to, scaled so that the middle of `from`
// has w > 0. Returns nothing where the points do not determine it (three of four on a line, NaN).
std::optional<Eigen::Matrix3d> FitHomography(const std::vector<Eigen::Vector2d>& from,
                                             const std::vector<Eigen::Vector2d>& to);

// Returns the map from the unit square's corners (0, 0), (1, 0), (1, 1), (0, 1) to a quadrilateral's.
std::optional<Eigen::Matrix3d> UnitSquareTo(const std::array<Eigen::Vector2d, 4>& corners);

// Returns the mapped point; NaN at and behind the horizon (w <= 0).
Eigen::Vector2d MapPoint(const Eigen::Matrix3d& homography, const Eigen::Vector2d& point);

// Returns d MapPoint / d point.
Eigen::Matrix2d MapJacobian(const Eigen::Matrix3d& homography, const Eigen::Vector2d& point);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_HOMOGRAPHY_H_
