#include "calib/calibrate/internal/target_pose.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "calib/lens/internal/rotation_vector.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

using Twist = Eigen::Matrix<double, 6, 1>;

constexpr double kMostTangent = 3.7;  // 75 degrees: a pinhole's image further out is unreliable
constexpr std::size_t kLeastPoints = 4;

// Returns the pose moved by a twist on the left: exp(rotation) * pose + translation.
Eigen::Isometry3d Moved(const Eigen::Isometry3d& pose, const Twist& twist) {
  Eigen::Isometry3d out = pose;
  out.linear() = RotationBy(twist.head<3>()) * pose.linear();
  out.translation() += twist.tail<3>();
  return out;
}

struct NormalEquations {
  Eigen::Matrix<double, 6, 6> hessian = Eigen::Matrix<double, 6, 6>::Zero();
  Twist gradient = Twist::Zero();
  double cost = 0;
};

NormalEquations Accumulate(const LensFunction& lens, const std::vector<SeenPoint>& points,
                           const Eigen::Isometry3d& pose, double loss_scale_px) {
  // A point without an image costs as much as a very wrong one, so that steps do not lose points.
  const double lost = loss_scale_px > 0 ? loss_scale_px * loss_scale_px * std::log1p(1e4) : 1e8;
  NormalEquations out;
  for (const SeenPoint& seen : points) {
    const Eigen::Vector3d turned = pose.linear() * seen.point;
    const Eigen::Vector3d p_in_rig = turned + pose.translation();
    const LensPoint image = ProjectByLens(lens, seen.parameters->data(), seen.cam_from_rig * p_in_rig, false);
    if (!image.pixel.allFinite() || !image.d_point.allFinite()) {
      out.cost += lost;
      continue;
    }
    const Eigen::Vector2d residual = seen.weight * (image.pixel - seen.pixel);
    Eigen::Matrix<double, 2, 6> jacobian;
    const Eigen::Matrix<double, 2, 3> d_rig = seen.weight * image.d_point * seen.cam_from_rig.linear();
    jacobian.leftCols<3>() << d_rig.col(2) * turned.y() - d_rig.col(1) * turned.z(),
        d_rig.col(0) * turned.z() - d_rig.col(2) * turned.x(),
        d_rig.col(1) * turned.x() - d_rig.col(0) * turned.y();
    jacobian.rightCols<3>() = d_rig;
    double weight = 1, cost = residual.squaredNorm();
    if (loss_scale_px > 0) {
      const double scale2 = loss_scale_px * loss_scale_px;
      weight = 1 / (1 + cost / scale2);
      cost = scale2 * std::log1p(cost / scale2);
    }
    out.cost += cost;
    out.hessian.noalias() += weight * jacobian.transpose() * jacobian;
    out.gradient.noalias() += weight * jacobian.transpose() * residual;
  }
  return out;
}

// Holds the points ahead of the camera, and their images on the plane z = 1.
struct NormalizedPoints {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> images;
  bool is_planar = true;  // all points lie in the target's plane z = 0
};

NormalizedPoints Normalized(const Camera& camera, const std::vector<SeenPoint>& points) {
  NormalizedPoints out;
  for (const SeenPoint& seen : points) {
    Eigen::Vector2d u((seen.pixel.x() - camera.cx_px) / camera.fx_px,
                      (seen.pixel.y() - camera.cy_px) / camera.fy_px);
    if (OpsOf(camera.lens).has_control_points) {
      const double ahead = 1 - u.squaredNorm() / 4;
      u = ahead > 0.05 ? Eigen::Vector2d(u / ahead) : Eigen::Vector2d::Constant(1e9);
    }
    if (!(u.norm() < kMostTangent)) continue;
    out.points.emplace_back(seen.point.x(), seen.point.y(), seen.point.z());
    out.images.emplace_back(u.x(), u.y());
    out.is_planar = out.is_planar && seen.point.z() == 0;
  }
  return out;
}

template <typename T>
std::vector<T> Kept(const std::vector<T>& all, const std::vector<unsigned char>& mask) {
  std::vector<T> kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (mask[i] != 0) kept.push_back(all[i]);
  }
  return kept;
}

std::vector<unsigned char> PlanarInliers(const NormalizedPoints& normalized, double gate) {
  std::vector<cv::Point2d> plane;
  plane.reserve(normalized.points.size());
  for (const cv::Point3d& p : normalized.points) plane.emplace_back(p.x, p.y);
  std::vector<unsigned char> mask;
  constexpr int kMostSamples = 300;
  cv::findHomography(plane, normalized.images, cv::RANSAC, gate, mask, kMostSamples, 0.995);
  return mask;
}

std::vector<unsigned char> SpatialInliers(const NormalizedPoints& normalized, double gate) {
  std::vector<unsigned char> mask(normalized.points.size(), 0);
  cv::Mat r, t;
  std::vector<int> inliers;
  constexpr int kMostSamples = 300;
  if (cv::solvePnPRansac(normalized.points, normalized.images, cv::Matx33d::eye(), cv::noArray(), r, t, false,
                         kMostSamples, static_cast<float>(gate), 0.995, inliers, cv::SOLVEPNP_AP3P)) {
    for (const int i : inliers) mask[static_cast<std::size_t>(i)] = 1;
  }
  return mask;
}

}  // namespace

Eigen::Isometry3d RefinePose(const LensFunction& lens, const std::vector<SeenPoint>& points,
                             const Eigen::Isometry3d& start, double loss_scale_px, int iterations) {
  Eigen::Isometry3d pose = start;
  NormalEquations now = Accumulate(lens, points, pose, loss_scale_px);
  double damping = 1e-4;
  for (int i = 0; i < iterations; ++i) {
    Eigen::Matrix<double, 6, 6> damped = now.hessian;
    damped.diagonal() *= 1 + damping;
    const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> factor(damped);
    const Twist step = -factor.solve(now.gradient);
    if (!step.allFinite()) break;
    const Eigen::Isometry3d moved = Moved(pose, step);
    const NormalEquations next = Accumulate(lens, points, moved, loss_scale_px);
    if (!(next.cost < now.cost)) {
      damping *= 10;
      if (damping > 1e6) break;
      continue;
    }
    const bool is_converged = now.cost - next.cost < 1e-12 * now.cost;
    pose = moved;
    now = next;
    damping = std::max(1e-9, damping / 10);
    if (is_converged) break;
  }
  return pose;
}

std::vector<Eigen::Isometry3d> PoseStarts(const Camera& camera, const std::vector<SeenPoint>& points,
                                          double gate_px) {
  const NormalizedPoints normalized = Normalized(camera, points);
  if (normalized.points.size() < kLeastPoints) return {};
  const double gate = gate_px / camera.fx_px;
  try {
    const std::vector<unsigned char> mask =
        normalized.is_planar ? PlanarInliers(normalized, gate) : SpatialInliers(normalized, gate);
    const std::vector<cv::Point3d> inlier_points = Kept(normalized.points, mask);
    if (mask.size() != normalized.points.size() || inlier_points.size() < kLeastPoints) return {};
    std::vector<cv::Mat> rs, ts;
    cv::solvePnPGeneric(inlier_points, Kept(normalized.images, mask), cv::Matx33d::eye(), cv::noArray(), rs,
                        ts, false, normalized.is_planar ? cv::SOLVEPNP_IPPE : cv::SOLVEPNP_SQPNP);
    std::vector<Eigen::Isometry3d> starts;
    for (std::size_t i = 0; i < rs.size(); ++i) {
      const Eigen::Isometry3d pose = PoseOf(rs[i].ptr<double>(), ts[i].ptr<double>());
      if (pose.matrix().allFinite()) starts.push_back(pose);
    }
    return starts;
  } catch (const cv::Exception&) {  // points on one line
    return {};
  }
}

double CappedCost(const LensFunction& lens, const std::vector<SeenPoint>& points,
                  const Eigen::Isometry3d& pose, double gate_px) {
  const double most = gate_px * gate_px;
  double cost = 0;
  for (const SeenPoint& seen : points) {
    const Eigen::Vector3d p = seen.cam_from_rig * (pose * seen.point);
    const double r2 =
        (ProjectByLens(lens, seen.parameters->data(), p, false).pixel - seen.pixel).squaredNorm();
    cost += r2 < most ? r2 : most;  // also where r2 is not a number
  }
  return cost;
}

}  // namespace luxfit
