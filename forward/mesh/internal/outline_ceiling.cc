#include "forward/mesh/internal/outline_ceiling.h"

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "forward/mesh/internal/plan_polygon.h"

namespace luxfit {
namespace {

constexpr double kPlaneM = 1e-6;
using Border = std::vector<Eigen::Vector3d>;

// z = slope . (x, y) + height.
struct CeilingPlane {
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  double height = 0;
  double At(const Eigen::Vector2d& p) const { return slope.dot(p) + height; }
};

std::optional<CeilingPlane> PlaneThrough(const Border& border) {
  Eigen::MatrixXd places(static_cast<Eigen::Index>(border.size()), 2);
  Eigen::VectorXd heights(places.rows());
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const Eigen::Vector3d& p = border[static_cast<size_t>(i)];
    places.row(i) = p.head<2>() - border[0].head<2>();
    heights[i] = p.z() - border[0].z();
  }
  CeilingPlane plane;
  plane.height = border[0].z();
  if (!heights.isZero(0)) {
    plane.slope = places.colPivHouseholderQr().solve(heights);
    plane.height -= plane.slope.dot(border[0].head<2>());
  }
  for (const Eigen::Vector3d& p : border) {
    if (std::abs(plane.At(p.head<2>()) - p.z()) > kPlaneM) return {};
  }
  return plane;
}

PlanPolygon Plan(const Border& border) {
  PlanPolygon plan;
  for (const Eigen::Vector3d& p : border) plan.emplace_back(p.head<2>());
  return plan;
}

// Returns the corners from i to j, both included, going on past the last one.
Border Between(const Border& border, size_t i, size_t j) {
  Border part;
  for (size_t k = i; k != j; k = (k + 1) % border.size()) part.push_back(border[k]);
  part.push_back(border[j]);
  return part;
}

// Finds the line along which to fold: one that leaves two planes, else one that cuts off the largest plane.
std::optional<std::pair<size_t, size_t>> FoldOf(const Border& border) {
  const PlanPolygon plan = Plan(border);
  std::optional<std::pair<size_t, size_t>> fold;
  size_t most = 0;
  double shortest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < border.size(); ++i) {
    for (size_t j = i + 2; j < border.size(); ++j) {
      if (i == 0 && j + 1 == border.size()) continue;
      const Border one = Between(border, i, j), other = Between(border, j, i);
      const size_t in_planes =
          (PlaneThrough(one) ? one.size() : 0) + (PlaneThrough(other) ? other.size() : 0);
      const double length = (plan[i] - plan[j]).norm();
      const bool is_better = in_planes > most || (in_planes == most && length < shortest);
      if (in_planes == 0 || !is_better || !IsChord(plan, i, j)) continue;
      most = in_planes;
      shortest = length;
      fold = {i, j};
    }
  }
  return fold;
}

}  // namespace

std::vector<Border> PlanePieces(const Border& border) {
  std::vector<Border> pieces;
  if (const auto plane = PlaneThrough(border)) {
    for (const PlanPolygon& rectangle : RectanglesOf(Plan(border))) {
      Border piece;
      for (const Eigen::Vector2d& p : rectangle) piece.emplace_back(p.x(), p.y(), plane->At(p));
      pieces.push_back(std::move(piece));
    }
    if (pieces.empty()) pieces.push_back(border);
    return pieces;
  }
  const auto fold = FoldOf(border);
  if (!fold) return {border};
  for (const auto& [i, j] : {*fold, std::pair(fold->second, fold->first)}) {
    std::vector<Border> part = PlanePieces(Between(border, i, j));
    std::move(part.begin(), part.end(), std::back_inserter(pieces));
  }
  return pieces;
}

std::array<Eigen::Vector2d, 4> PlanOf(const RoomBox& box) {
  const Eigen::Vector2d low = box.min_m.head<2>(), high = box.max_m.head<2>(), middle = 0.5 * (low + high);
  std::array<Eigen::Vector2d, 4> plan{low, Eigen::Vector2d(high.x(), low.y()), high,
                                      Eigen::Vector2d(low.x(), high.y())};
  if (box.turn_rad == 0) return plan;
  const double c = std::cos(box.turn_rad), s = std::sin(box.turn_rad);
  for (Eigen::Vector2d& p : plan) {
    const Eigen::Vector2d d = p - middle;
    p = middle + Eigen::Vector2d(c * d.x() - s * d.y(), s * d.x() + c * d.y());
  }
  return plan;
}

}  // namespace luxfit
