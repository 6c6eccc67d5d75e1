#include "forward/room/internal/inside_solid.h"

#include <cmath>

#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

constexpr int kDirections = 16;
constexpr int kLeastOpen = kDirections / 4;

// Returns Fibonacci's lattice on the hemisphere around z.
Eigen::Matrix<double, 3, kDirections> Lattice() {
  Eigen::Matrix<double, 3, kDirections> directions;
  for (int k = 0; k < kDirections; ++k) {
    const double z = (k + 0.5) / kDirections, angle = k * 2.399963229728653;
    const double rho = std::sqrt(1 - z * z);
    directions.col(k) << rho * std::cos(angle), rho * std::sin(angle), z;
  }
  return directions;
}

bool IsBack(const RayHit& hit) { return hit.facet >= 0 && !hit.front; }

// Tells whether a ray ended in the open.
bool IsOpen(const Scene& scene, const RayScene& rays, const RayHit& hit) {
  if (hit.facet < 0) return true;
  if (!hit.front) return false;
  const Facet& facet = scene.facets[static_cast<size_t>(hit.facet)];
  const Eigen::Vector3d normal = facet.Normal();
  return !IsBack(rays.Trace(LiftedOff(facet.PointAt(hit.u, hit.v), normal), normal));
}

}  // namespace

bool IsInsideSolid(const Scene& scene, const RayScene& rays, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& normal) {
  const Eigen::Vector3d start = LiftedOff(p, normal);
  // The ray along the normal goes first: it misses what stands beside the point or flush with it.
  if (!IsBack(rays.Trace(start, normal))) return false;
  static const Eigen::Matrix<double, 3, kDirections> lattice = Lattice();
  const Eigen::Matrix<double, 3, kDirections> directions = FrameOf(normal) * lattice;
  int open = 0;
  for (int k = 0; k < kDirections && open < kLeastOpen; ++k)
    open += IsOpen(scene, rays, rays.Trace(start, directions.col(k))) ? 1 : 0;
  return open < kLeastOpen;
}

}  // namespace luxfit
