#include "forward/radiosity/internal/leaf_light.h"

#include <algorithm>
#include <cmath>

#include "forward/room/internal/inside_solid.h"
#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

struct PointState {
  bool free = false;   // the point lies in no solid
  bool lands = false;  // light that leaves it along one random ray meets a front
};

PointState StateAt(const Scene& scene, const RayScene& rays, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& normal, uint64_t hash) {
  if (IsInsideSolid(scene, rays, p, normal)) return {};
  const double radius2 = UnitFrom(hash = Mix(hash)), turns = UnitFrom(Mix(hash));
  const RayHit hit = rays.Trace(LiftedOff(p, normal), FrameOf(normal) * LiftedFromDisc(radius2, turns));
  return {true, hit.facet >= 0 && hit.front};
}

}  // namespace

LeafLight EvaluateLeaf(const LightTree& tree, const Scene& scene, const RayScene& rays,
                       const DirectLight& direct_lx, int leaf) {
  const LightNode& node = tree[leaf];
  const Probes probes = ProbesOf(node);
  constexpr int kPoints = 4;  // per probe
  uint64_t hash = Mix(static_cast<uint64_t>(leaf));
  double free = 0, sum = 0, square = 0;
  int points = 0, landing = 0;
  for (int k = 0; k < probes.count; ++k) {
    Eigen::Vector3d lit_at = probes.points[static_cast<size_t>(k)];
    bool lit = StateAt(scene, rays, lit_at, node.normal, hash = Mix(hash)).free;
    int free_points = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double u = UnitFrom(hash = Mix(hash)), v = UnitFrom(hash = Mix(hash));
      const Eigen::Vector3d p = PointAroundProbe(node, k, u, v);
      const PointState state = StateAt(scene, rays, p, node.normal, hash = Mix(hash));
      if (!state.free) continue;
      ++free_points;
      landing += state.lands ? 1 : 0;
      if (!lit) lit_at = p;
      lit = true;
    }
    if (!lit) continue;
    points += free_points;
    // The probe itself counts where all points around it, few as they are, fall into the solid.
    const double share = static_cast<double>(std::max(free_points, 1)) / (kPoints * probes.count);
    const double lx = direct_lx(lit_at, node.normal);
    free += share;
    sum += share * lx;
    square += share * lx * lx;
  }
  if (free == 0) return {};
  const double mean = sum / free;
  const double deviation = std::sqrt(std::max(0.0, square / free - mean * mean));
  const double lands = points > 0 ? static_cast<double>(landing) / points : 1;
  return {static_cast<float>(mean), static_cast<float>(deviation), static_cast<float>(free),
          static_cast<float>(lands)};
}

}  // namespace luxfit
