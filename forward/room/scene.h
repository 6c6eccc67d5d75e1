// Describes the room's geometry: planar facets, each of one material. forward/mesh reads it from files.
//
//   p(u, v) = origin + u edge_u + v edge_v,   parallelogram: u, v in [0, 1];   triangle: also u + v <= 1
//
// Metres, world frame (right-handed, z up). The front of a facet is the side that its normal points to:
// normal = edge_u x edge_v / |edge_u x edge_v|. The front reflects; both sides block light.
//
// FacetsFromPolygon makes facets of polygons, rectangles as one parallelogram each.
#ifndef LUXFIT_FORWARD_ROOM_SCENE_H_
#define LUXFIT_FORWARD_ROOM_SCENE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

namespace luxfit {

enum class FacetKind { kTriangle, kParallelogram };

struct Facet {
  FacetKind kind = FacetKind::kParallelogram;
  Eigen::Vector3d origin;
  Eigen::Vector3d edge_u;
  Eigen::Vector3d edge_v;
  int material = 0;          // index into Scene::materials
  double covered_share = 1;  // share of it where there is a surface; less than 1 only in Scene::surface

  Eigen::Vector3d Normal() const { return edge_u.cross(edge_v).normalized(); }
  double AreaM2() const {
    return (kind == FacetKind::kTriangle ? 0.5 : 1.0) * covered_share * edge_u.cross(edge_v).norm();
  }
  Eigen::Vector3d PointAt(double u, double v) const { return origin + u * edge_u + v * edge_v; }
  // Returns (u, v) of the point of the facet's plane that is nearest to p.
  Eigen::Vector2d CoordinatesOf(const Eigen::Vector3d& p) const;
};

// A triangle of a surface that lies on a facet and covers a part of it. Its corners are (u, v) of the facet, in the
// facet's sense.
struct SurfaceTriangle {
  std::array<Eigen::Vector2d, 3> corners;
  int facet = 0;
};

struct Scene {
  std::vector<std::string> materials;
  std::vector<Facet> facets;
  // Empty: facets are surface all over. Else they are surface only where these triangles lie (forward/mesh/planes.h).
  std::vector<SurfaceTriangle> surface;
  int dropped_facets = 0;  // left out because they have no area

  Eigen::AlignedBox3d Bounds() const;
  // Returns the air in front of the facets, m3: -sum (z - z_min) n_z A, z of the facets' centroids. Holds for a
  // closed room whose solids face outwards. They may lack the side on the floor or at a wall.
  double VolumeM3() const;
};

// The material of surfaces to which a file gives none.
constexpr char kDefaultMaterial[] = "DefaultMaterial";

// Returns a planar polygon (counter-clockwise seen from its front, convex or not) as one parallelogram or
// several triangles. Triangles without area are left out, so the list may be empty.
std::vector<Facet> FacetsFromPolygon(const std::vector<Eigen::Vector3d>& vertices, int material);

// Returns the surface as facets: those of the scene, or the triangles that cover them.
std::vector<Facet> SurfaceFacets(const Scene& scene);

// Returns the least distance from a point to any facet, m; infinity for an empty scene.
double DistanceToSurface(const Scene& scene, const Eigen::Vector3d& p_in_world);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_SCENE_H_
