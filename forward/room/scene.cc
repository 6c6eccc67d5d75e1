#include "forward/room/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "forward/room/internal/facet_corners.h"

namespace luxfit {
namespace {

constexpr double kParallelogramTolerance = 1e-6;  // relative to edge length: files carry six to seven digits
constexpr double kMinAreaM2 = 1e-12;

Facet MakeTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                   int material) {
  return {FacetKind::kTriangle, a, b - a, c - a, material};
}

// Returns Newell's normal, which is robust for any planar polygon, convex or not.
Eigen::Vector3d NewellNormal(const std::vector<Eigen::Vector3d>& polygon) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < polygon.size(); ++i) {
    normal += (polygon[i] - polygon[0]).cross(polygon[(i + 1) % polygon.size()] - polygon[0]);
  }
  return normal;
}

bool InTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                const Eigen::Vector3d& c, const Eigen::Vector3d& normal) {
  const auto left = [&](const Eigen::Vector3d& s, const Eigen::Vector3d& t) {
    return normal.dot((t - s).cross(p - s)) >= 0;
  };
  return left(a, b) && left(b, c) && left(c, a);
}

// Triangulates by ear clipping (Meisters 1975): quadratic, enough for the polygons that modellers draw.
std::vector<Facet> Triangulate(std::vector<Eigen::Vector3d> polygon, int material) {
  std::vector<Facet> triangles;
  const Eigen::Vector3d normal = NewellNormal(polygon);
  while (polygon.size() > 2) {
    const size_t n = polygon.size();
    const auto before = [n](size_t i) { return i == 0 ? n - 1 : i - 1; };
    const auto after = [n](size_t i) { return i == n - 1 ? 0 : i + 1; };
    size_t ear = 0;  // a self-crossing outline has no ear: cut the first corner then
    for (size_t i = 0; i < n; ++i) {
      const Eigen::Vector3d &a = polygon[before(i)], &b = polygon[i], &c = polygon[after(i)];
      if (normal.dot((b - a).cross(c - b)) <= 0) continue;
      bool empty = true;
      for (size_t k = 0; k < n && empty; ++k) {
        const bool corner = k == i || k == after(i) || k == before(i);
        empty = corner || !InTriangle(polygon[k], a, b, c, normal);
      }
      if (empty) {
        ear = i;
        break;
      }
    }
    const Facet triangle = MakeTriangle(polygon[before(ear)], polygon[ear], polygon[after(ear)], material);
    if (triangle.AreaM2() > kMinAreaM2) triangles.push_back(triangle);
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

double DistanceToFacet(const Facet& facet, const Eigen::Vector3d& p) {
  // Least squares for (u, v), clamped: exact for rectangles, an upper bound within the shear for others.
  const Eigen::Vector2d at = facet.CoordinatesOf(p);
  double u = std::clamp(at[0], 0.0, 1.0), v = std::clamp(at[1], 0.0, 1.0);
  if (facet.kind == FacetKind::kTriangle && u + v > 1) {
    const double excess = 0.5 * (u + v - 1);
    u = std::clamp(u - excess, 0.0, 1.0);
    v = 1 - u;
  }
  return (p - facet.PointAt(u, v)).norm();
}

// Returns the box of a scan's room with each side moved in to the largest plane that lies near it and faces inwards, there
// to its innermost corner: scraps stick out, and what lies behind a ceiling is not in the room.
Eigen::AlignedBox3d WithinOuterPlanes(const Scene& scene, const Eigen::AlignedBox3d& box) {
  constexpr double kNearM = 0.1, kAlongAxis = 0.99;
  Eigen::AlignedBox3d inner = box;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double inwards : {1.0, -1.0}) {
      double& side = inwards > 0 ? inner.min()[axis] : inner.max()[axis];
      double largest_m2 = 0;
      for (const Facet& facet : scene.facets) {
        const Eigen::AlignedBox3d own = BoxOf(facet, 0);
        const double innermost = inwards > 0 ? own.max()[axis] : own.min()[axis];
        const double outer = inwards > 0 ? box.min()[axis] : box.max()[axis];
        if (inwards * facet.Normal()[axis] < kAlongAxis || std::abs(innermost - outer) > kNearM ||
            facet.AreaM2() <= largest_m2)
          continue;
        largest_m2 = facet.AreaM2();
        side = innermost;
      }
    }
  }
  return inner;
}

}  // namespace

Eigen::Vector2d Facet::CoordinatesOf(const Eigen::Vector3d& p) const {
  const double uu = edge_u.squaredNorm(), vv = edge_v.squaredNorm(), uv = edge_u.dot(edge_v);
  const double u = edge_u.dot(p - origin), v = edge_v.dot(p - origin);
  return Eigen::Vector2d(vv * u - uv * v, uu * v - uv * u) / (uu * vv - uv * uv);
}

Eigen::AlignedBox3d Scene::Bounds() const {
  Eigen::AlignedBox3d box;
  for (const Facet& facet : facets) box.extend(BoxOf(facet, 0));
  return surface.empty() ? box : WithinOuterPlanes(*this, box);
}

double Scene::VolumeM3() const {
  if (facets.empty()) return 0;
  const double floor_m = Bounds().min().z();
  double volume_m3 = 0;
  for (const Facet& facet : facets) {
    const bool triangle = facet.kind == FacetKind::kTriangle;
    const double mean_m = facet.PointAt(triangle ? 1. / 3 : 0.5, triangle ? 1. / 3 : 0.5).z() - floor_m;
    volume_m3 -= mean_m * facet.edge_u.cross(facet.edge_v).z() * (triangle ? 0.5 : 1.0);
  }
  return volume_m3;
}

std::vector<Facet> FacetsFromPolygon(const std::vector<Eigen::Vector3d>& vertices, int material) {
  if (vertices.size() == 4) {
    const Eigen::Vector3d gap = vertices[0] + vertices[2] - vertices[1] - vertices[3];
    const Facet whole{FacetKind::kParallelogram, vertices[0], vertices[1] - vertices[0],
                      vertices[3] - vertices[0], material};
    const double size = (vertices[2] - vertices[0]).norm();
    if (gap.norm() < kParallelogramTolerance * size && whole.AreaM2() > kMinAreaM2) return {whole};
  }
  return Triangulate(vertices, material);
}

std::vector<Facet> SurfaceFacets(const Scene& scene) {
  if (scene.surface.empty()) return scene.facets;
  std::vector<Facet> triangles;
  triangles.reserve(scene.surface.size());
  for (const SurfaceTriangle& triangle : scene.surface) {
    const Facet& facet = scene.facets[static_cast<size_t>(triangle.facet)];
    const auto at = [&](size_t k) { return facet.PointAt(triangle.corners[k].x(), triangle.corners[k].y()); };
    triangles.push_back({FacetKind::kTriangle, at(0), at(1) - at(0), at(2) - at(0), facet.material});
  }
  return triangles;
}

double DistanceToSurface(const Scene& scene, const Eigen::Vector3d& p_in_world) {
  double least = std::numeric_limits<double>::infinity();
  for (const Facet& facet : SurfaceFacets(scene)) least = std::min(least, DistanceToFacet(facet, p_in_world));
  return least;
}

}  // namespace luxfit
