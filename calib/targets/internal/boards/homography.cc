#include "calib/targets/internal/boards/homography.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <limits>

namespace luxfit {
namespace {

// Returns the map that moves the mean to the origin and scales the mean distance from it to sqrt(2).
Eigen::Matrix3d Normalisation(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) mean += point / static_cast<double>(points.size());
  double distance = 0;
  for (const Eigen::Vector2d& point : points)
    distance += (point - mean).norm() / static_cast<double>(points.size());
  const double scale = distance > 0 ? std::sqrt(2.0) / distance : 1;
  Eigen::Matrix3d normalise = Eigen::Matrix3d::Identity();
  normalise.topLeftCorner<2, 2>() *= scale;
  normalise.topRightCorner<2, 1>() = -scale * mean;
  return normalise;
}

}  // namespace

std::optional<Eigen::Matrix3d> FitHomography(const std::vector<Eigen::Vector2d>& from,
                                             const std::vector<Eigen::Vector2d>& to) {
  if (from.size() < 4 || from.size() != to.size()) return std::nullopt;
  const Eigen::Matrix3d from_scale = Normalisation(from), to_scale = Normalisation(to);
  Eigen::MatrixXd a(2 * static_cast<Eigen::Index>(from.size()), 9);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Eigen::RowVector3d p = (from_scale * from[i].homogeneous()).transpose();
    const Eigen::Vector3d q = to_scale * to[i].homogeneous();
    a.row(2 * static_cast<Eigen::Index>(i)) << p, 0, 0, 0, -q.x() * p;
    a.row(2 * static_cast<Eigen::Index>(i) + 1) << 0, 0, 0, p, -q.y() * p;
  }
  if (!a.allFinite()) return std::nullopt;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeFullV);
  constexpr double kLeastRank = 1e-6;  // ratio of the eighth singular value to the first
  if (!(svd.singularValues()[7] > kLeastRank * svd.singularValues()[0])) return std::nullopt;
  const Eigen::Matrix<double, 9, 1> h = svd.matrixV().col(8);
  const Eigen::Matrix3d scaled = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(h.data());
  Eigen::Matrix3d homography = to_scale.inverse() * scaled * from_scale;
  if (scaled(2, 2) < 0) homography = -homography;  // w at the normalised origin: the middle of `from`
  return homography;
}

std::optional<Eigen::Matrix3d> UnitSquareTo(const std::array<Eigen::Vector2d, 4>& corners) {
  return FitHomography({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {corners.begin(), corners.end()});
}

Eigen::Vector2d MapPoint(const Eigen::Matrix3d& homography, const Eigen::Vector2d& point) {
  const Eigen::Vector3d mapped = homography * point.homogeneous();
  if (!(mapped.z() > 0)) return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  return mapped.hnormalized();
}

Eigen::Matrix2d MapJacobian(const Eigen::Matrix3d& homography, const Eigen::Vector2d& point) {
  const Eigen::Vector3d mapped = homography * point.homogeneous();
  return (homography.topLeftCorner<2, 2>() - mapped.hnormalized() * homography.bottomLeftCorner<1, 2>()) /
         mapped.z();
}

}  // namespace luxfit
