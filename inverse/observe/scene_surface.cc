#include "inverse/observe/scene_surface.h"

#include <array>
#include <vector>

namespace luxfit {

TriangleSurface SurfaceOf(const Scene& scene) {
  TriangleSurface surface;
  const std::vector<Facet> all = SurfaceFacets(scene);
  const auto facets = static_cast<Eigen::Index>(all.size());
  surface.vertices_m.resize(3, 4 * facets);
  std::vector<Eigen::Vector3i> triangles;
  for (Eigen::Index f = 0; f < facets; ++f) {
    const Facet& facet = all[static_cast<size_t>(f)];
    const std::array<Eigen::Vector3d, 4> corners{facet.PointAt(0, 0), facet.PointAt(1, 0),
                                                 facet.PointAt(0, 1), facet.PointAt(1, 1)};
    for (Eigen::Index c = 0; c < 4; ++c) surface.vertices_m.col(4 * f + c) = corners[static_cast<size_t>(c)];
    const auto first = static_cast<int>(4 * f);
    triangles.emplace_back(first, first + 1, first + 2);
    if (facet.kind == FacetKind::kParallelogram) triangles.emplace_back(first + 1, first + 3, first + 2);
  }
  surface.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (size_t t = 0; t < triangles.size(); ++t)
    surface.triangles.col(static_cast<Eigen::Index>(t)) = triangles[t];
  return surface;
}

}  // namespace luxfit
