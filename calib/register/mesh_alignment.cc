#include "calib/register/mesh_alignment.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "calib/lens/internal/rotation_vector.h"
#include "calib/luminance/median.h"
#include "calib/register/internal/triangle_tree.h"
#include "calib/register/millimetres.h"
#include "calib/targets/internal/boards/solve_symmetric.h"

namespace luxfit {
namespace {

using Matrix7 = Eigen::Matrix<double, 7, 7>;
using Vector7 = Eigen::Matrix<double, 7, 1>;

void CheckSurface(const TriangleSurface& surface) {
  if (surface.triangles.cols() == 0)
    throw std::invalid_argument("AlignPointsToSurface: expected a triangle or more");
  if (surface.triangles.minCoeff() < 0 || surface.triangles.maxCoeff() >= surface.vertices_m.cols())
    throw std::invalid_argument("AlignPointsToSurface: expected triangles of the surface's vertices");
}

// Holds the points at their present places, with their nearest places on the surface.
struct Laid {
  Eigen::Matrix3Xd in_world;
  std::vector<SurfacePlane> planes;
  std::vector<double> distances_m;  // along the normal, signed
  std::vector<bool> counts;
  double scatter_m = 0;
  double share = 0;
};

Laid LayDown(const Eigen::Matrix3Xd& points, const TriangleTree& tree, const Similarity& world_from_points,
             double gate_m) {
  Laid laid;
  laid.in_world.resize(3, points.cols());
  std::vector<double> near_m;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d p = world_from_points * points.col(i);
    const NearestPoint nearest = tree.Nearest(p);
    const Eigen::Vector3d normal = tree.Normal(nearest.triangle);
    laid.in_world.col(i) = p;
    laid.planes.push_back({normal, nearest.p, 0});
    laid.distances_m.push_back(normal.dot(p - nearest.p));
    laid.counts.push_back(nearest.squared_distance < gate_m * gate_m && normal.squaredNorm() > 0);
    if (laid.counts.back()) near_m.push_back(std::abs(laid.distances_m.back()));
  }
  if (!near_m.empty()) laid.scatter_m = kSigmaPerMad * Median(near_m);
  laid.share =
      points.cols() == 0 ? 0 : static_cast<double>(near_m.size()) / static_cast<double>(points.cols());
  return laid;
}

struct Normal {
  Matrix7 left = Matrix7::Zero();
  Vector7 right = Vector7::Zero();
};

// Returns the normal equations of (rotation vector, shift, log scale) about `middle`.
Normal NormalEquations(const Laid& laid, const Eigen::Vector3d& middle, bool scale_is_free) {
  Normal normal;
  for (std::size_t i = 0; i < laid.planes.size(); ++i) {
    if (!laid.counts[i]) continue;
    const Eigen::Vector3d arm = laid.in_world.col(static_cast<Eigen::Index>(i)) - middle;
    const Eigen::Vector3d& n = laid.planes[i].normal;
    Vector7 d;
    d << arm.cross(n), n, scale_is_free ? n.dot(arm) : 0;
    normal.left += d * d.transpose();
    normal.right -= d * laid.distances_m[i];
  }
  return normal;
}

// Damping of steps, as this many points at one metre: directions that nothing determines stay where they are.
constexpr double kDamping = 1e-3;

Similarity Step(const Similarity& now, const Normal& normal, const Eigen::Vector3d& middle) {
  const Vector7 step = SolveSymmetric(normal.left + kDamping * Matrix7::Identity(), normal.right);
  Similarity next = now;
  const double grow = std::exp(std::clamp(step[6], -0.2, 0.2));
  const Eigen::Matrix3d turn = RotationBy(step.head<3>());
  next.scale = now.scale * grow;
  next.rotation = turn * now.rotation;
  next.translation = grow * (turn * (now.translation - middle)) + middle + step.segment<3>(3);
  return next;
}

// Returns the variance of one point's distance such that all points together determine the place no better
// than the mesh is known. Its error counts as if each of its six sides (walls, floor, ceiling) had one.
double VarianceOfPoints(const Laid& laid, const SurfaceAlignmentOptions& options) {
  constexpr double kSides = 6;
  const auto n = static_cast<double>(std::count(laid.counts.begin(), laid.counts.end(), true));
  return laid.scatter_m * laid.scatter_m +
         options.mesh_sigma_m * options.mesh_sigma_m * std::max(1.0, n / kSides);
}

Matrix7 CovarianceOf(const Normal& normal, const Laid& laid, const SurfaceAlignmentOptions& options) {
  const auto n = static_cast<double>(std::count(laid.counts.begin(), laid.counts.end(), true));
  Matrix7 left = normal.left;
  if (!options.scale_is_free) left(6, 6) = 1;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(left);
  const Vector7 values = eigen.eigenvalues().cwiseMax(1e-12 * n);
  Matrix7 covariance = VarianceOfPoints(laid, options) * eigen.eigenvectors() *
                       values.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  if (!options.scale_is_free) {
    covariance.row(6).setZero();
    covariance.col(6).setZero();
  }
  return covariance;
}

// Returns sigma in the worst direction of a point, at the points' typical distance from their middle.
double WorstSigma(const Matrix7& covariance, const Laid& laid, const Eigen::Vector3d& middle) {
  double squared = 0, count = 0;
  for (std::size_t i = 0; i < laid.counts.size(); ++i) {
    if (!laid.counts[i]) continue;
    squared += (laid.in_world.col(static_cast<Eigen::Index>(i)) - middle).squaredNorm();
    ++count;
  }
  const double radius_m = std::sqrt(squared / std::max(1.0, count));
  Vector7 in_metres;
  in_metres << radius_m, radius_m, radius_m, 1, 1, 1, radius_m;
  const Matrix7 scaled = in_metres.asDiagonal() * covariance * in_metres.asDiagonal();
  return std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues()[6]);
}

Eigen::Vector3d MiddleOf(const Laid& laid) { return laid.in_world.rowwise().mean(); }

}  // namespace

SurfaceAlignment AlignPointsToSurface(const Eigen::Matrix3Xd& points, const TriangleSurface& surface,
                                      const Similarity& start, const SurfaceAlignmentOptions& options) {
  CheckSurface(surface);
  SurfaceAlignment alignment;
  alignment.world_from_points = start;
  constexpr Eigen::Index kFewestPoints = 12;
  if (points.cols() < kFewestPoints) {
    alignment.message = "there are " + std::to_string(points.cols()) + " points, 12 and more are needed";
    return alignment;
  }
  const TriangleTree tree(surface.vertices_m, surface.triangles);
  double gate_m = options.rough_m;
  Laid laid;
  constexpr int kSteps = 100;
  for (int step = 0; step < kSteps; ++step) {
    laid = LayDown(points, tree, alignment.world_from_points, gate_m);
    const Eigen::Vector3d middle = MiddleOf(laid);
    const Similarity next =
        Step(alignment.world_from_points, NormalEquations(laid, middle, options.scale_is_free), middle);
    const double moved_m = (next * points.col(0) - alignment.world_from_points * points.col(0)).norm();
    alignment.world_from_points = next;
    const double closing = std::max({0.9 * gate_m, 3 * laid.scatter_m, 3 * options.mesh_sigma_m});
    const bool is_closed = closing >= gate_m;
    gate_m = std::min(gate_m, closing);
    if (is_closed && moved_m < 1e-7) break;
  }
  laid = LayDown(points, tree, alignment.world_from_points, gate_m);
  alignment.middle_in_world = MiddleOf(laid);
  alignment.scatter_m = laid.scatter_m;
  const Normal normal = NormalEquations(laid, alignment.middle_in_world, options.scale_is_free);
  alignment.covariance = CovarianceOf(normal, laid, options);
  const double sigma_m = WorstSigma(alignment.covariance, laid, alignment.middle_in_world);
  alignment.planes = laid.planes;
  const double plane_sigma_m = std::sqrt(VarianceOfPoints(laid, options));
  for (std::size_t i = 0; i < laid.planes.size(); ++i) {
    if (laid.counts[i]) alignment.planes[i].sigma_m = plane_sigma_m;
  }
  const double grown = alignment.world_from_points.scale / start.scale;
  if (!(laid.share >= options.least_share)) {
    alignment.message = fmt::format(
        "{:.2g} % of the points lie on the mesh: it shows another room, or the start is too rough",
        100 * laid.share);
  } else if (!(sigma_m <= options.most_sigma_m)) {
    alignment.message =
        fmt::format("the points leave a direction free by {}: surfaces of three directions are needed",
                    Millimetres(sigma_m));
  } else if (grown < 0.5 || grown > 2) {
    alignment.message =
        fmt::format("the size came out {:.2g} times that of the start: the start is too rough", grown);
  }
  alignment.is_determined = alignment.message.empty();
  return alignment;
}

std::optional<Similarity> StartFromPlaces(const std::vector<FeatureView>& views,
                                          const std::map<std::string, Eigen::Vector3d>& places_m,
                                          std::optional<double> scale) {
  Eigen::Matrix3Xd centers(3, 0), places(3, 0);
  for (const FeatureView& view : views) {
    const auto place = places_m.find(view.view);
    if (place == places_m.end()) continue;
    centers.conservativeResize(Eigen::NoChange, centers.cols() + 1);
    places.conservativeResize(Eigen::NoChange, places.cols() + 1);
    centers.rightCols<1>() = view.cam_from_model.inverse().translation();
    places.rightCols<1>() = place->second;
  }
  return FitSimilarity(centers, places, scale);
}

FeatureModel OnSurface(const FeatureModel& features, const SurfaceAlignment& alignment) {
  if (alignment.planes.size() != features.tracks.size())
    throw std::invalid_argument("OnSurface: expected the alignment of these features' points");
  FeatureModel moved = Moved(features, alignment.world_from_points);
  for (std::size_t i = 0; i < moved.tracks.size(); ++i) {
    if (alignment.planes[i].sigma_m > 0) moved.tracks[i].surface = alignment.planes[i];
  }
  return moved;
}

Registration MovedToSurface(const Registration& registration, const SurfaceAlignment& alignment) {
  Registration moved = registration;
  moved.frame = "surface";
  const Similarity& motion = alignment.world_from_points;
  const auto rows = static_cast<Eigen::Index>(6 * moved.views.size());
  Eigen::MatrixXd turn = Eigen::MatrixXd::Zero(rows, rows), by_motion = Eigen::MatrixXd::Zero(rows, 7);
  for (std::size_t i = 0; i < moved.views.size(); ++i) {
    RegisteredView& view = moved.views[i];
    view.cam_from_world = PoseUnder(motion, view.cam_from_world);
    const auto at = 6 * static_cast<Eigen::Index>(i);
    turn.block<3, 3>(at, at) = turn.block<3, 3>(at + 3, at + 3) = motion.rotation;
    // A turn about the points' middle moves the camera with them.
    const Eigen::Vector3d arm = view.cam_from_world.inverse().translation() - alignment.middle_in_world;
    by_motion.block<3, 3>(at, 0).setIdentity();
    by_motion.block<3, 3>(at + 3, 0) = -CrossMatrix(arm);
    by_motion.block<3, 3>(at + 3, 3).setIdentity();
    by_motion.block<3, 1>(at + 3, 6) = arm;
  }
  // The motion's own error is common to all views.
  moved.pose_covariance = turn * registration.pose_covariance * turn.transpose() +
                          by_motion * alignment.covariance * by_motion.transpose();
  for (std::size_t i = 0; i < moved.views.size(); ++i) {
    const auto at = 6 * static_cast<Eigen::Index>(i);
    moved.views[i].covariance = moved.pose_covariance.block<6, 6>(at, at);
    moved.views[i].position_sigma_m = moved.views[i].covariance.diagonal().tail<3>().cwiseSqrt();
  }
  for (SurveyedTag& tag : moved.placed_tags) {
    tag.center_in_world = motion * tag.center_in_world;
    tag.normal_in_world = motion.rotation * tag.normal_in_world;
    tag.up_in_world = motion.rotation * tag.up_in_world;
    tag.size_m *= motion.scale;
  }
  return moved;
}

}  // namespace luxfit
