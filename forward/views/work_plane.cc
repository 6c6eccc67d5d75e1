#include "forward/views/illuminance_plane.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "forward/room/internal/facet_corners.h"
#include "forward/room/internal/inside_solid.h"

namespace luxfit {
namespace {

constexpr double kLeastUp = 0.99;         // least cosine of a facet that faces up
constexpr double kFloorThickness = 0.05;  // m
constexpr double kStandardBand = 0.5;     // m
constexpr double kBandShare = 0.15;       // as a share of the shorter side

std::vector<Facet> FloorFacets(const Scene& scene) {
  std::vector<Facet> floor;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Facet& facet : scene.facets) {
    if (facet.Normal().z() < kLeastUp) continue;
    floor.push_back(facet);
    lowest = std::min(lowest, facet.origin.z());
  }
  floor.erase(std::remove_if(floor.begin(), floor.end(),
                             [&](const Facet& facet) { return facet.origin.z() > lowest + kFloorThickness; }),
              floor.end());
  return floor;
}

Eigen::Vector2d Across(const Eigen::Vector2d& u) { return {-u.y(), u.x()}; }

// Returns the box of the floor, in coordinates along u and across it.
Eigen::AlignedBox2d BoxAlong(const std::vector<Facet>& floor, const Eigen::Vector2d& u) {
  Eigen::AlignedBox2d box;
  for (const Facet& facet : floor) {
    for (const Eigen::Vector3d& corner : CornersOf(facet)) {
      const Eigen::Vector2d p = corner.head<2>();
      box.extend(Eigen::Vector2d(p.dot(u), p.dot(Across(u))));
    }
  }
  return box;
}

// Returns the direction of the least rectangle: it has a side along an edge. It is turned by whole quarters
// to lie nearest to +x.
Eigen::Vector2d DirectionOf(const std::vector<Facet>& floor) {
  Eigen::Vector2d best = Eigen::Vector2d::UnitX();
  double least = BoxAlong(floor, best).volume();
  constexpr size_t kMaxFacets = 200;  // on a finely cut floor each is as good as its neighbour
  const size_t step = floor.size() / kMaxFacets + 1;
  for (size_t f = 0; f < floor.size(); f += step) {
    const FacetCorners corners = CornersOf(floor[f]);
    for (size_t i = 0; i < corners.count; ++i) {
      const Eigen::Vector3d edge = corners.points[(i + 1) % corners.count] - corners.points[i];
      Eigen::Vector2d u = edge.head<2>().normalized();
      if (std::abs(u.y()) > std::abs(u.x())) u = Eigen::Vector2d(u.y(), -u.x());
      const double area = BoxAlong(floor, u).volume();
      if (area > 0.999 * least) continue;
      least = area;
      best = u.x() < 0 ? Eigen::Vector2d(-u) : u;
    }
  }
  return best;
}

bool IsWithin(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& p) {
  bool within = false;
  for (size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Eigen::Vector2d &a = outline[i], &b = outline[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      within = !within;
  }
  return within;
}

bool IsOverFloor(const Room& room, const Eigen::Vector3d& p) {
  const RayHit hit = room.rays.Trace(p, -Eigen::Vector3d::UnitZ());
  return hit.facet >= 0 && hit.front;
}

}  // namespace

std::optional<IlluminancePlane> FloorPlane(const Scene& scene, double height_m, double margin_m) {
  const std::vector<Facet> floor = FloorFacets(scene);
  if (floor.empty()) return std::nullopt;
  const Eigen::Vector2d u = DirectionOf(floor), v = Across(u);
  const Eigen::AlignedBox2d box = BoxAlong(floor, u);
  const double band = std::min(kStandardBand, kBandShare * box.sizes().minCoeff());
  const double margin = margin_m < 0 ? band : margin_m;
  const Eigen::Vector2d size = box.sizes().array() - 2 * margin;
  if (!(size.minCoeff() > 0)) return std::nullopt;
  const Eigen::Vector2d corner = box.min().array() + margin;
  IlluminancePlane plane;
  plane.origin << corner.x() * u + corner.y() * v, floor.front().origin.z() + height_m;
  plane.edge_u << size.x() * u, 0;
  plane.edge_v << size.y() * v, 0;
  return plane;
}

IlluminancePlane PlaneOverOutline(const std::vector<Eigen::Vector2d>& outline_m, double z_m) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : outline_m) box.extend(p);
  if (outline_m.size() < 3 || !(box.sizes().minCoeff() > 0))
    throw std::invalid_argument("PlaneOverOutline: expected an outline with an area");
  IlluminancePlane plane;
  plane.origin << box.min(), z_m;
  plane.edge_u << box.sizes().x(), 0, 0;
  plane.edge_v << 0, box.sizes().y(), 0;
  return plane;
}

std::vector<GridPointKind> ClassifyPoints(const Room& room, const PlaneGrid& grid,
                                          const std::vector<Eigen::Vector2d>& outline_m, bool over_floor) {
  std::vector<GridPointKind> kinds;
  kinds.reserve(static_cast<size_t>(grid.points.cols()));
  for (Eigen::Index k = 0; k < grid.points.cols(); ++k) {
    const Eigen::Vector3d p = grid.points.col(k);
    const bool is_solid = IsInsideSolid(room.scene, room.rays, p, grid.normal);
    const bool is_outlined = outline_m.empty() || IsWithin(outline_m, p.head<2>());
    const bool is_outside = !is_outlined || (!is_solid && over_floor && !IsOverFloor(room, p));
    kinds.push_back(is_outside ? GridPointKind::kOutside
                               : (is_solid ? GridPointKind::kInSolid : GridPointKind::kCounts));
  }
  return kinds;
}

}  // namespace luxfit
