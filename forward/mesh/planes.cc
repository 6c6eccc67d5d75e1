#include "forward/mesh/planes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "forward/mesh/internal/close_holes.h"
#include "forward/mesh/internal/grow_planes.h"
#include "forward/mesh/internal/plane_names.h"
#include "forward/mesh/internal/scan_mesh.h"

namespace luxfit {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Segmented {
  ScanMesh mesh;
  PlanarRegions regions;
  LaidOnPlanes how;
};

PlanarRegions RegionsOf(const ScanMesh& mesh, const PlanesOptions& options) {
  constexpr double kCoarser = 1.5, kCoarsest = 10;
  PlanarRegions regions;
  for (double factor = 1; factor < kCoarsest; factor *= kCoarser) {
    regions = GrowPlanes(mesh, factor * options.off_plane_m);
    if (regions.planes.size() <= static_cast<size_t>(options.most_planes)) return regions;
  }
  return GatherSmall(mesh, regions, PatchesOptions{}.patch_size_m);
}

double RmsOffPlane(const ScanMesh& mesh, const PlanarRegions& regions) {
  double sum = 0, area = 0;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (regions.of_triangle[t] < 0) continue;
    const Plane& plane = regions.planes[static_cast<size_t>(regions.of_triangle[t])];
    const double weight = mesh.AreaNormal(t).norm() / 3;
    for (size_t k = 0; k < 3; ++k) sum += weight * std::pow(plane.Above(mesh.Corner(t, k)), 2);
    area += 3 * weight;
  }
  return area > 0 ? std::sqrt(sum / area) : 0;
}

Segmented Segment(const Scene& scene, const PlanesOptions& options) {
  Segmented segmented{MakeScanMesh(scene), {}, {}};
  segmented.regions = RegionsOf(segmented.mesh, options);
  segmented.how.triangles = static_cast<int>(scene.facets.size());
  segmented.how.rms_m = RmsOffPlane(segmented.mesh, segmented.regions);
  segmented.how.closed_holes = CloseHoles(options.largest_hole_m, segmented.mesh, segmented.regions);
  return segmented;
}

// Returns the point that lies on all of the planes, as far as they determine it, nearest to p.
Vector3d OnAll(const std::set<int>& which, const std::vector<Plane>& planes, const Vector3d& p) {
  constexpr double kParallel = 0.02;  // two planes 16 degrees apart determine their line
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  for (const int r : which) {
    const Plane& plane = planes[static_cast<size_t>(r)];
    normal_matrix += plane.normal * plane.normal.transpose();
    right -= plane.Above(p) * plane.normal;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal_matrix);
  Vector3d shift = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vector3d& direction = solver.eigenvectors().col(k);
    if (solver.eigenvalues()[k] > kParallel)
      shift += direction.dot(right) / solver.eigenvalues()[k] * direction;
  }
  return p + shift;
}

std::vector<Vector3d> VerticesOnPlanes(const Segmented& room) {
  std::vector<std::set<int>> meet(room.mesh.vertices.size());
  for (size_t t = 0; t < room.mesh.triangles.size(); ++t) {
    for (const int v : room.mesh.triangles[t])
      meet[static_cast<size_t>(v)].insert(room.regions.of_triangle[t]);
  }
  std::vector<Vector3d> placed = room.mesh.vertices;
  for (size_t v = 0; v < placed.size(); ++v) placed[v] = OnAll(meet[v], room.regions.planes, placed[v]);
  return placed;
}

// Returns the horizontal direction that most walls run along, or stand square to.
Vector3d MainDirection(const PlanarRegions& regions) {
  constexpr double kUpright = 0.3;
  Vector2d sum = Vector2d::Zero();
  for (size_t r = 0; r < regions.planes.size(); ++r) {
    const Vector3d& n = regions.planes[r].normal;
    if (std::abs(n.z()) > kUpright) continue;
    const double angle = std::atan2(n.y(), n.x());
    sum += regions.area_m2[r] * Vector2d(std::cos(4 * angle), std::sin(4 * angle));
  }
  const double angle = std::atan2(sum.y(), sum.x()) / 4;
  return {std::cos(angle), std::sin(angle), 0};
}

// Returns unit vectors in the plane, u x v = normal: upright planes have u level, level ones along the walls.
struct Axes {
  Vector3d u, v;
};
Axes AxesOf(const Plane& plane, const Vector3d& main_direction) {
  constexpr double kLevel = 0.95;
  const Vector3d u = std::abs(plane.normal.z()) < kLevel
                         ? Vector3d::UnitZ().cross(plane.normal)
                         : Vector3d(main_direction - main_direction.dot(plane.normal) * plane.normal);
  return {u.normalized(), plane.normal.cross(u).normalized()};
}

// Lays the triangles of one region onto its plane and makes a facet around them.
class RegionFacet {
 public:
  RegionFacet(const Segmented& room, const std::vector<Vector3d>& placed, const Vector3d& main_direction,
              int region)
      : room_(room),
        placed_(placed),
        plane_(room.regions.planes[static_cast<size_t>(region)]),
        axes_(AxesOf(plane_, main_direction)) {}

  void Add(size_t t) {
    SurfaceTriangle triangle;
    for (size_t k = 0; k < 3; ++k) {
      const Vector3d& p = placed_[static_cast<size_t>(room_.mesh.triangles[t][k])];
      triangle.corners[k] = {axes_.u.dot(p), axes_.v.dot(p)};
    }
    const double area_m2 = AreaOf(triangle);
    if (area_m2 <= kLeastM2) return;  // folded by moving its corners
    area_m2_ += area_m2;
    for (const Vector2d& corner : triangle.corners) box_.extend(corner);
    triangles_.push_back(triangle);
  }

  void AddTo(Scene& scene, int material) {
    if (triangles_.empty()) return;
    const Vector2d size = box_.sizes();
    Facet facet;
    facet.origin = plane_.offset_m * plane_.normal + box_.min().x() * axes_.u + box_.min().y() * axes_.v;
    facet.edge_u = size.x() * axes_.u;
    facet.edge_v = size.y() * axes_.v;
    facet.material = material;
    facet.covered_share = std::min(1.0, area_m2_ / (size.x() * size.y()));
    for (SurfaceTriangle& triangle : triangles_) {
      for (Vector2d& corner : triangle.corners) corner = (corner - box_.min()).cwiseQuotient(size);
      triangle.facet = static_cast<int>(scene.facets.size());
      scene.surface.push_back(triangle);
    }
    scene.facets.push_back(facet);
  }

 private:
  static constexpr double kLeastM2 = 1e-10;

  static double AreaOf(const SurfaceTriangle& triangle) {
    const Vector2d a = triangle.corners[1] - triangle.corners[0],
                   b = triangle.corners[2] - triangle.corners[0];
    return 0.5 * (a.x() * b.y() - a.y() * b.x());
  }

  const Segmented& room_;
  const std::vector<Vector3d>& placed_;
  const Plane& plane_;
  Axes axes_;
  std::vector<SurfaceTriangle> triangles_;
  Eigen::AlignedBox2d box_;
  double area_m2_ = 0;
};

}  // namespace

OnPlanes LayOnPlanes(const Scene& mesh, const PlanesOptions& options) {
  const Segmented room = Segment(mesh, options);
  OnPlanes result;
  result.how = room.how;
  result.scene.materials = mesh.materials;
  result.scene.dropped_facets = mesh.dropped_facets;
  const std::vector<int> material =
      NamePlanes(room.mesh, room.regions, options.named_material, result.scene.materials);
  const std::vector<Vector3d> placed = VerticesOnPlanes(room);
  const Vector3d main_direction = MainDirection(room.regions);
  std::vector<RegionFacet> facets;
  facets.reserve(material.size());
  for (size_t r = 0; r < material.size(); ++r)
    facets.emplace_back(room, placed, main_direction, static_cast<int>(r));
  for (size_t t = 0; t < room.mesh.triangles.size(); ++t) {
    if (room.regions.of_triangle[t] >= 0) facets[static_cast<size_t>(room.regions.of_triangle[t])].Add(t);
  }
  for (size_t r = 0; r < material.size(); ++r) facets[r].AddTo(result.scene, material[r]);
  return result;
}

Scene WithTrianglesMerged(const Scene& mesh) {
  constexpr double kSamePlaneM = 5e-4, kMuchFewer = 3;
  if (!IsFinerThanPatches(mesh, {})) return mesh;
  PlanesOptions exact;
  exact.off_plane_m = kSamePlaneM;
  exact.largest_hole_m = 0;
  exact.most_planes = static_cast<int>(mesh.facets.size());
  OnPlanes laid = LayOnPlanes(mesh, exact);
  if (kMuchFewer * CountPatches(laid.scene, {}).patches > CountPatches(mesh, {}).patches) return mesh;
  return std::move(laid.scene);
}

bool IsFinerThanPatches(const Scene& mesh, const PatchesOptions& options) {
  constexpr double kManyPatches = 1500, kTooMany = 3;
  double area_m2 = 0;
  for (const Facet& facet : mesh.facets) area_m2 += facet.AreaM2();
  const double patches = CountPatches(mesh, options).patches;
  return patches > kManyPatches && patches > kTooMany * area_m2 / std::pow(options.patch_size_m, 2);
}

}  // namespace luxfit
