#include "forward/mesh/ray_shares.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "forward/room/visibility.h"

namespace luxfit {
namespace {

constexpr size_t kMostFacets = 4096;
constexpr int kRays = 64;
constexpr double kGoldenAngleRad = 2.399963229728653;

struct RayCounts {
  double kept = 0, escaped = 0, back = 0;
};

RayCounts CountFrom(const RayScene& rays, const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d along = normal.unitOrthogonal(), across = normal.cross(along);
  RayCounts counts;
  for (int k = 0; k < kRays; ++k) {
    const double square = (k + 0.5) / kRays, radius = std::sqrt(square), turn = kGoldenAngleRad * k;
    const Eigen::Vector3d direction =
        radius * std::cos(turn) * along + radius * std::sin(turn) * across + std::sqrt(1 - square) * normal;
    const RayHit hit = rays.Trace(LiftedOff(p, normal), direction);
    (hit.facet < 0 ? counts.escaped : (hit.front ? counts.kept : counts.back)) += 1;
  }
  return counts;
}

// Counts by area.
RayCounts CountFrom(const RayScene& rays, const Facet& facet) {
  const bool triangle = facet.kind == FacetKind::kTriangle;
  const double area_m2 = facet.AreaM2();
  RayCounts sum;
  for (const double u : {0.27, 0.73}) {
    for (const double v : {0.27, 0.73}) {
      const double within = triangle ? 0.5 : 1.0;
      const RayCounts counts = CountFrom(rays, facet.PointAt(within * u, within * v), facet.Normal());
      if (counts.kept == 0) continue;
      sum.kept += area_m2 * counts.kept;
      sum.escaped += area_m2 * counts.escaped;
      sum.back += area_m2 * counts.back;
    }
  }
  return sum;
}

}  // namespace

RayShares EstimateRayShares(const Scene& scene) {
  const size_t count = std::min(kMostFacets, scene.facets.size());
  if (count == 0) return {};
  const RayScene rays(scene);
  std::vector<RayCounts> of_facet(count);
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    of_facet[i] = CountFrom(rays, scene.facets[i * scene.facets.size() / count]);
  });
  RayCounts sum;  // in order: the same for any number of threads
  for (const RayCounts& counts : of_facet) {
    sum.kept += counts.kept;
    sum.escaped += counts.escaped;
    sum.back += counts.back;
  }
  const double all = sum.kept + sum.escaped + sum.back;
  if (all == 0) return {1, 0};
  return {sum.escaped / all, sum.back / all};
}

}  // namespace luxfit
