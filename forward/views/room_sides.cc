#include "forward/views/room_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "forward/room/internal/facet_corners.h"

namespace luxfit {
namespace {

constexpr double kFurnitureGapM = 0.05;
constexpr double kLeastAreaM2 = 0.5;
constexpr double kWithinSideM = 0.02;
constexpr double kSameNormal = 0.9995;  // cosine of 1.8 degrees
constexpr double kWallTilt = 0.3;       // largest |z| of a wall's normal
constexpr double kCeilingTilt = -0.7;   // largest z of a ceiling's normal

Eigen::Vector3d MiddleOf(const Facet& facet) {
  const double middle = facet.kind == FacetKind::kTriangle ? 1.0 / 3 : 0.5;
  return facet.PointAt(middle, middle);
}

bool BoundsRoom(const Room& room, const Facet& facet) {
  const Eigen::Vector3d normal = facet.Normal();
  return room.rays.Trace(LiftedOff(MiddleOf(facet), -normal), -normal).facet < 0;
}

// Returns the side whose plane the facet lies in; null: none yet.
RoomSide* SideWith(const Scene& scene, const Facet& facet, std::vector<RoomSide>& sides) {
  const auto side = std::find_if(sides.begin(), sides.end(), [&](const RoomSide& one) {
    const Facet& first = scene.facets[static_cast<size_t>(one.facets.front())];
    const Eigen::Vector3d normal = first.Normal();
    return normal.dot(facet.Normal()) > kSameNormal &&
           std::abs(normal.dot(MiddleOf(facet) - first.origin)) < kWithinSideM;
  });
  return side == sides.end() ? nullptr : &*side;
}

IlluminancePlane RectangleOver(const Scene& scene, const RoomSide& side) {
  const Facet& first = scene.facets[static_cast<size_t>(side.facets.front())];
  const Eigen::Vector3d normal = first.Normal();
  const Eigen::Vector3d along = side.is_ceiling
                                    ? Eigen::Vector3d(Eigen::Vector3d::UnitX() - normal.x() * normal)
                                    : Eigen::Vector3d(Eigen::Vector3d::UnitZ().cross(normal));
  const Eigen::Vector3d u = along.normalized(), v = normal.cross(u);
  Eigen::AlignedBox2d box;
  for (const int f : side.facets) {
    const FacetCorners corners = CornersOf(scene.facets[static_cast<size_t>(f)]);
    for (size_t i = 0; i < corners.count; ++i)
      box.extend(Eigen::Vector2d(corners.points[i].dot(u), corners.points[i].dot(v)));
  }
  IlluminancePlane plane;
  plane.origin =
      box.min().x() * u + box.min().y() * v + (first.origin.dot(normal) + RoomSide::kOffSurfaceM) * normal;
  plane.edge_u = box.sizes().x() * u;
  plane.edge_v = box.sizes().y() * v;
  plane.spacing_m = 0.2 * std::pow(5, std::log10(box.sizes().maxCoeff()));
  return plane;
}

bool IsOver(const Facet& facet, const Eigen::Vector3d& point) {
  const Eigen::Vector2d uv = facet.CoordinatesOf(point);
  if (uv.minCoeff() < 0 || uv.maxCoeff() > 1) return false;
  return facet.kind != FacetKind::kTriangle || uv.sum() <= 1;
}

// Tells whether furniture stands against the side there. Its face to the wall may be missing: then a back is seen.
bool IsCovered(const Room& room, const Eigen::Vector3d& normal, const Eigen::Vector3d& point) {
  const RayHit hit = room.rays.Trace(point, normal);
  return hit.facet >= 0 && (!hit.front || hit.distance < kFurnitureGapM);
}

}  // namespace

std::vector<RoomSide> SidesOf(const Room& room) {
  const Scene& scene = room.scene;
  std::vector<RoomSide> sides;
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    const Facet& facet = scene.facets[f];
    const double up = facet.Normal().z();
    const bool is_ceiling = up < kCeilingTilt;
    if ((std::abs(up) > kWallTilt && !is_ceiling) || !BoundsRoom(room, facet)) continue;
    RoomSide* side = SideWith(scene, facet, sides);
    if (side == nullptr) {
      side = &sides.emplace_back();
      side->is_ceiling = is_ceiling;
    }
    side->facets.push_back(static_cast<int>(f));
    side->area_m2 += facet.AreaM2();
  }
  sides.erase(std::remove_if(sides.begin(), sides.end(),
                             [](const RoomSide& side) { return side.area_m2 < kLeastAreaM2; }),
              sides.end());
  std::stable_partition(sides.begin(), sides.end(), [](const RoomSide& side) { return !side.is_ceiling; });
  for (RoomSide& side : sides) side.plane = RectangleOver(scene, side);
  return sides;
}

std::vector<GridPointKind> ClassifySidePoints(const Room& room, const RoomSide& side, const PlaneGrid& grid) {
  std::vector<GridPointKind> kinds = ClassifyPoints(room, grid, {}, false);
  for (size_t i = 0; i < kinds.size(); ++i) {
    const Eigen::Vector3d point = grid.points.col(static_cast<Eigen::Index>(i));
    const bool is_over = std::any_of(side.facets.begin(), side.facets.end(), [&](int f) {
      return IsOver(room.scene.facets[static_cast<size_t>(f)], point);
    });
    if (!is_over) {
      kinds[i] = GridPointKind::kOutside;
    } else if (IsCovered(room, grid.normal, point)) {
      kinds[i] = GridPointKind::kInSolid;
    }
  }
  return kinds;
}

}  // namespace luxfit
