#include "inverse/furniture/internal/hull_planes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "forward/changes/plane_moves.h"

namespace luxfit {
namespace {

constexpr double kLeastFacetM2 = 0.1;
constexpr double kSameWay = 0.9998;  // 1 degree
constexpr double kLeastCellM = 0.1, kCellsOfPlane = 700;

bool LiesIn(const Facet& facet, const HullPlane& plane) {
  if (facet.Normal().dot(plane.normal) < kSameWay) return false;
  for (const double u : {0.0, 1.0})
    for (const double v : {0.0, 1.0})
      if (std::abs(plane.normal.dot(facet.PointAt(u, v)) - plane.offset_m) > kOnPlaneM) return false;
  return true;
}

std::vector<HullPlane> PlanesOf(const Scene& scene) {
  std::vector<std::pair<double, int>> by_area;
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    const double area_m2 = scene.facets[f].AreaM2();
    if (area_m2 >= kLeastFacetM2) by_area.emplace_back(-area_m2, static_cast<int>(f));
  }
  std::sort(by_area.begin(), by_area.end());
  std::vector<HullPlane> planes;
  for (const auto& [minus_area_m2, f] : by_area) {
    const Facet& facet = scene.facets[static_cast<size_t>(f)];
    auto plane = std::find_if(planes.begin(), planes.end(),
                              [&facet = facet](const HullPlane& p) { return LiesIn(facet, p); });
    if (plane == planes.end()) {
      planes.push_back({facet.Normal(), facet.Normal().dot(facet.origin), {}, 0, {}});
      plane = planes.end() - 1;
    }
    plane->facets.push_back(f);
    plane->area_m2 -= minus_area_m2;
  }
  planes.erase(std::remove_if(planes.begin(), planes.end(),
                              [](const HullPlane& p) { return p.area_m2 < kLeastPlaneM2; }),
               planes.end());
  return planes;
}

// Tells whether a ray from behind a place meets no front. A side of a solid is met from within, and is none.
bool IsOpenBehind(const RayScene& rays, const PieceCell& cell) {
  constexpr int kMostHits = 8;
  Eigen::Vector3d from = LiftedOff(cell.place, -cell.normal);
  for (int i = 0; i < kMostHits; ++i) {
    const RayHit hit = rays.Trace(from, -cell.normal);
    if (hit.facet < 0) return true;
    if (hit.front) return false;
    from = LiftedOff(from - hit.distance * cell.normal, -cell.normal);
  }
  return false;
}

}  // namespace

std::vector<HullPlane> FindHullPlanes(const Scene& scene, const RayScene& rays) {
  std::vector<HullPlane> hull;
  for (HullPlane& plane : PlanesOf(scene)) {
    const double cell_m = std::max(kLeastCellM, std::sqrt(plane.area_m2 / kCellsOfPlane));
    plane.cells = CellsOf(scene, plane.facets, cell_m);
    const auto open = std::count_if(plane.cells.begin(), plane.cells.end(),
                                    [&](const PieceCell& cell) { return IsOpenBehind(rays, cell); });
    if (2 * static_cast<size_t>(open) > plane.cells.size()) hull.push_back(std::move(plane));
  }
  return hull;
}

}  // namespace luxfit
