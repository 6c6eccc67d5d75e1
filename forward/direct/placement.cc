#include "forward/direct/placement.h"

#include <cmath>

#include "forward/direct/internal/luminous_surface.h"
#include "forward/luminaire/internal/expect_luminaire.h"

namespace luxfit {
namespace {

constexpr int kDirections = 128;  // a front of a tenth of the sphere is met by a dozen

constexpr double kMostBacks = 0.4;

bool IsInRoom(const RayScene& rays, const Eigen::Vector3d& p) {
  int fronts = 0, backs = 0;
  for (int i = 0; i < kDirections; ++i) {
    // Fibonacci's lattice on the sphere.
    const double z = 1 - (2 * i + 1.0) / kDirections, angle = i * 2.399963229728653;
    const double rho = std::sqrt(1 - z * z);
    const RayHit hit = rays.Trace(p, {rho * std::cos(angle), rho * std::sin(angle), z});
    if (hit.facet >= 0) ++(hit.front ? fronts : backs);
  }
  return fronts > 0 && backs <= kMostBacks * kDirections;
}

}  // namespace

double ShareOutsideRoom(const RayScene& rays, const Luminaire& luminaire) {
  ExpectValid(luminaire);
  const LuminousSurface surface(luminaire);
  double share = 0;
  for (const SurfaceSample& s : SampleSurface(luminaire.shape, 2)) {
    if (!IsInRoom(rays, surface.PointOf({s.a, s.b}))) share += s.weight;
  }
  return share;
}

}  // namespace luxfit
