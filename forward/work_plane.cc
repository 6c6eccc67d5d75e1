#include "forward/work_plane.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "forward/internal/inside_solid.h"

namespace luxfit {
namespace {

constexpr double kLeastUp = 0.99;         // cosine of what faces up
constexpr double kFloorThickness = 0.05;  // m
constexpr double kStandardBand = 0.5;     // m
constexpr double kBandShare = 0.15;       // of the shorter side

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

// Along the floor's largest facet, turned by whole quarters to lie nearest to +x.
Eigen::Vector2d DirectionOf(const std::vector<Facet>& floor) {
  const auto largest = std::max_element(
      floor.begin(), floor.end(), [](const Facet& a, const Facet& b) { return a.AreaM2() < b.AreaM2(); });
  Eigen::Vector2d along = largest->edge_u.head<2>().normalized();
  if (std::abs(along.y()) > std::abs(along.x())) along = Eigen::Vector2d(along.y(), -along.x());
  return along.x() < 0 ? -along : along;
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
  const Eigen::Vector2d u = DirectionOf(floor), v(-u.y(), u.x());
  Eigen::AlignedBox2d box;
  for (const Facet& facet : floor) {
    for (const auto& corner :
         {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 1)}) {
      if (facet.kind == FacetKind::kTriangle && corner.sum() > 1) continue;
      const Eigen::Vector2d p = facet.PointAt(corner[0], corner[1]).head<2>();
      box.extend(Eigen::Vector2d(p.dot(u), p.dot(v)));
    }
  }
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
    GridPointKind kind = GridPointKind::kCounts;
    if ((!outline_m.empty() && !IsWithin(outline_m, p.head<2>()))) {
      kind = GridPointKind::kOutside;
    } else if (IsInsideSolid(room.scene, room.rays, p, grid.normal)) {
      kind = GridPointKind::kInSolid;
    } else if (over_floor && !IsOverFloor(room, p)) {
      kind = GridPointKind::kOutside;
    }
    kinds.push_back(kind);
  }
  return kinds;
}

}  // namespace luxfit
