#include "calib/register/internal/survey/tag_surfaces.h"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

struct Triangle {
  Eigen::Vector3d a, b, c;

  Eigen::Vector3d TwiceArea() const { return (b - a).cross(c - a); }

  // Tells whether the projection of p along the triangle's normal falls into it.
  bool IsUnder(const Eigen::Vector3d& p) const {
    constexpr double kEdge = 1e-9;  // of the area: a point on a quad's diagonal falls into one half at least
    const Eigen::Vector3d area = TwiceArea();
    const double least = -kEdge * area.squaredNorm();
    return area.dot((b - a).cross(p - a)) >= least && area.dot((c - b).cross(p - b)) >= least &&
           area.dot((a - c).cross(p - c)) >= least;
  }
};

Triangle TriangleOf(const TriangleSurface& surface, Eigen::Index index) {
  const Eigen::Vector3i corners = surface.triangles.col(index);
  return {surface.vertices_m.col(corners[0]), surface.vertices_m.col(corners[1]),
          surface.vertices_m.col(corners[2])};
}

// Returns the triangle's plane where the tag may hang on it.
std::optional<SurfacePlane> PlaneUnderTag(const SurveyedTag& tag, const Triangle& triangle,
                                          const TagSurfaceSearch& search) {
  constexpr double kParallel = 0.98480775;  // cos 10 degrees
  const Eigen::Vector3d area = triangle.TwiceArea();
  if (!(area.norm() > 0)) return std::nullopt;
  Eigen::Vector3d normal = area.normalized();
  if (normal.dot(tag.normal_in_world) < 0) normal = -normal;
  const double height_m = normal.dot(tag.center_in_world - triangle.a);
  if (!(normal.dot(tag.normal_in_world) >= kParallel) || !(std::abs(height_m) <= search.reach_m) ||
      !triangle.IsUnder(tag.center_in_world))
    return std::nullopt;
  return SurfacePlane{normal, tag.center_in_world - height_m * normal, search.sigma_m};
}

}  // namespace

std::optional<SurfacePlane> SurfaceUnderTag(const SurveyedTag& tag, const TriangleSurface& surface,
                                            const TagSurfaceSearch& search) {
  if (surface.triangles.cols() > 0 &&
      (surface.triangles.minCoeff() < 0 || surface.triangles.maxCoeff() >= surface.vertices_m.cols()))
    throw std::invalid_argument("RegisterViews: expected triangles of the surface's vertices");
  std::optional<SurfacePlane> found;
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    const std::optional<SurfacePlane> plane = PlaneUnderTag(tag, TriangleOf(surface, t), search);
    if (!plane) continue;
    if (found && (plane->on_surface - found->on_surface).norm() > search.sigma_m) return std::nullopt;
    if (!found) found = plane;
  }
  return found;
}

SurveyedTag LaidOn(const SurfacePlane& plane, SurveyedTag tag) {
  tag.center_in_world = plane.on_surface;
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(tag.normal_in_world, plane.normal);
  constexpr double kExact_rad = M_PI / 180;
  if (turn.angularDistance(Eigen::Quaterniond::Identity()) < kExact_rad) return tag;
  tag.normal_in_world = plane.normal;
  tag.up_in_world = turn * tag.up_in_world;
  return tag;
}

}  // namespace luxfit
