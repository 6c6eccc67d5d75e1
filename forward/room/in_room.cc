#include "forward/room/in_room.h"

#include <cmath>

namespace luxfit {
namespace {

constexpr int kDirectionsOfPoint = 128;  // a front of a tenth of the sphere is met by a dozen
constexpr double kMostBacks = 0.4;

}  // namespace

bool IsInRoom(const RayScene& rays, const Eigen::Vector3d& p) {
  int fronts = 0, backs = 0;
  for (int i = 0; i < kDirectionsOfPoint; ++i) {
    // Fibonacci's lattice on the sphere.
    const double z = 1 - (2 * i + 1.0) / kDirectionsOfPoint, angle = i * 2.399963229728653;
    const double rho = std::sqrt(1 - z * z);
    const RayHit hit = rays.Trace(p, {rho * std::cos(angle), rho * std::sin(angle), z});
    if (hit.facet >= 0) ++(hit.front ? fronts : backs);
  }
  return fronts > 0 && backs <= kMostBacks * kDirectionsOfPoint;
}

Eigen::Vector3d InFrontOf(const Scene& scene, const RayHit& hit, const Eigen::Vector3d& place,
                          double in_front_m) {
  const Facet& facet = scene.facets[static_cast<size_t>(hit.facet)];
  const Eigen::Vector3d normal = hit.front ? facet.Normal() : -facet.Normal();
  return place + (normal.dot(facet.PointAt(hit.u, hit.v) - place) + in_front_m) * normal;
}

}  // namespace luxfit
