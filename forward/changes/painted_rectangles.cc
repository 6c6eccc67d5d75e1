#include "forward/changes/painted_rectangles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace luxfit {
namespace {

constexpr double kInPlaneM = 1e-3, kNarrowM = 5e-3;

// Returns what the rectangle covers of the facet, in the facet's coordinates; an empty box where it covers nothing or
// cannot be cut.
Eigen::AlignedBox2d CoveredPart(const Facet& facet, const PaintedRectangle& rectangle) {
  constexpr double kFacesAlike = 1 - 1e-6, kParallel = 1e-3;
  const Eigen::Vector3d normal = facet.Normal(),
                        front = rectangle.edge_u.cross(rectangle.edge_v).normalized();
  if (facet.kind != FacetKind::kParallelogram || normal.dot(front) < kFacesAlike ||
      std::abs(normal.dot(rectangle.corner - facet.origin)) > kInPlaneM)
    return {};
  const Eigen::Vector2d corner = facet.CoordinatesOf(rectangle.corner);
  const Eigen::Vector2d u = facet.CoordinatesOf(rectangle.corner + rectangle.edge_u) - corner,
                        v = facet.CoordinatesOf(rectangle.corner + rectangle.edge_v) - corner;
  if (std::min(u.cwiseAbs().minCoeff(), v.cwiseAbs().minCoeff()) > kParallel) return {};
  Eigen::AlignedBox2d part(corner);
  part.extend(corner + u + v);
  const Eigen::Vector2d narrow(kNarrowM / facet.edge_u.norm(), kNarrowM / facet.edge_v.norm());
  for (int axis = 0; axis < 2; ++axis) {
    if (part.min()[axis] < narrow[axis]) part.min()[axis] = 0;
    if (part.max()[axis] > 1 - narrow[axis]) part.max()[axis] = 1;
    if (part.sizes()[axis] < narrow[axis]) return {};
  }
  return part;
}

Facet PartOf(const Facet& facet, const Eigen::AlignedBox2d& part, int material) {
  Facet cut = facet;
  cut.origin = facet.PointAt(part.min().x(), part.min().y());
  cut.edge_u *= part.sizes().x();
  cut.edge_v *= part.sizes().y();
  cut.material = material;
  return cut;
}

// Adds the part with that material, and the strips beside it with the facet's.
void Cut(const Facet& facet, const Eigen::AlignedBox2d& part, int material, std::vector<Facet>& facets) {
  facets.push_back(PartOf(facet, part, material));
  const auto add_strip = [&](const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
    if ((high - low).minCoeff() > 0) facets.push_back(PartOf(facet, {low, high}, facet.material));
  };
  const Eigen::Vector2d &low = part.min(), &high = part.max();
  add_strip({0, 0}, {low.x(), 1});
  add_strip({high.x(), 0}, {1, 1});
  add_strip({low.x(), 0}, {high.x(), low.y()});
  add_strip({low.x(), high.y()}, {high.x(), 1});
}

}  // namespace

Scene WithPaintedRectangles(Scene scene, const std::vector<PaintedRectangle>& rectangles) {
  if (!scene.surface.empty()) return scene;
  for (const PaintedRectangle& rectangle : rectangles) {
    const int material = static_cast<int>(scene.materials.size());
    std::vector<Facet> facets;
    bool is_cut = false;
    for (const Facet& facet : scene.facets) {
      const Eigen::AlignedBox2d part = CoveredPart(facet, rectangle);
      if (part.isEmpty()) {
        facets.push_back(facet);
      } else {
        Cut(facet, part, material, facets);
        is_cut = true;
      }
    }
    if (!is_cut) continue;
    scene.materials.push_back(rectangle.name);
    scene.facets = std::move(facets);
  }
  return scene;
}

}  // namespace luxfit
