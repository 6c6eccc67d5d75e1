#include "forward/factors/internal/visible_share.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

constexpr int kMaxRaysPerPair = 256;
constexpr int kFirstRaysPerPatchPair = 4;
constexpr int kMixedShare =
    32;  // a pair where visibility is mixed gets this part of the rays of a hemisphere, or more

// Points spread over two facets: the additive recurrence of the generalised golden ratio in four dimensions.
class PairSequence {
 public:
  explicit PairSequence(uint64_t seed) {
    for (double& s : at_) s = UnitFrom(seed = Mix(seed));
  }
  void Skip(int n) {
    for (int d = 0; d < 4; ++d) {
      at_[d] += n * kGoldenSteps[d];
      at_[d] -= std::floor(at_[d]);
    }
  }
  // Dimensions `first` and the next, on a facet.
  Eigen::Vector3d On(const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                     bool triangle, int first) const {
    const bool mirrored = triangle && at_[first] + at_[first + 1] > 1;
    const double a = mirrored ? 1 - at_[first] : at_[first],
                 b = mirrored ? 1 - at_[first + 1] : at_[first + 1];
    return origin + a * u + b * v;
  }

 private:
  double at_[4];
};

struct Sum {
  float visible = 0, total = 0;
  int count = 0;
};

// Rays of one pair after the other, traced eight at a time.
class SightRays {
 public:
  SightRays(const RayScene& rays, const Patches& patches, std::vector<Sum>& sums)
      : rays_(rays), patches_(patches), sums_(sums) {}

  // Adds `count` rays from an element to patch j to sums[slot].
  void Add(int e, int j, int count, size_t slot) {
    const Element& element = patches_.elements[static_cast<size_t>(e)];
    const Patch& patch = patches_.patches[static_cast<size_t>(j)];
    const Eigen::Vector3d normal = patches_.facets[static_cast<size_t>(patch.facet)].Normal();
    const bool from_triangle = patches_.IsTriangle(element.patch), to_triangle = patches_.IsTriangle(j);
    PairSequence sequence(Mix(static_cast<uint64_t>(e)) + static_cast<uint64_t>(j));
    sequence.Skip(sums_[slot].count);
    for (int k = 0; k < count; ++k, sequence.Skip(1)) {
      const Eigen::Vector3d from = LiftedOff(
          sequence.On(element.origin, element.edge_u, element.edge_v, from_triangle, 0), element.normal);
      const Eigen::Vector3d d = sequence.On(patch.origin, patch.edge_u, patch.edge_v, to_triangle, 2) - from;
      const double here = element.normal.dot(d), there = -normal.dot(d), r2 = d.squaredNorm();
      ++sums_[slot].count;
      if (here <= 0 || there <= 0) continue;
      const float weight = static_cast<float>(here * there / (r2 * r2));
      sums_[slot].total += weight;
      // What is buried or covered of a patch must not count: only rays that meet this very facet first do.
      Queue& queue = patch.is_whole ? shadow_ : first_hit_;
      queue.slot[queue.packet.count] = slot;
      queue.weight[queue.packet.count] = weight;
      queue.facet[queue.packet.count] = patch.facet;
      queue.packet.Add(from.cast<float>(), d.cast<float>());
      if (queue.packet.count == RayPacket::kSize) Cast(queue);
    }
  }
  int64_t Flush() {
    Cast(shadow_);
    Cast(first_hit_);
    return cast_;
  }

 private:
  struct Queue {
    RayPacket packet;
    size_t slot[RayPacket::kSize];
    float weight[RayPacket::kSize];
    int facet[RayPacket::kSize];
  };

  void Cast(Queue& queue) {
    if (queue.packet.count == 0) return;
    cast_ += queue.packet.count;
    if (&queue == &shadow_) {
      const unsigned blocked = rays_.Occluded(queue.packet);
      for (int k = 0; k < queue.packet.count; ++k) {
        if ((blocked >> k & 1u) == 0) sums_[queue.slot[k]].visible += queue.weight[k];
      }
    } else {
      const PacketHits hits = rays_.Trace(queue.packet);
      for (int k = 0; k < queue.packet.count; ++k) {
        if (hits.facet[k] == queue.facet[k] && hits.front[k]) sums_[queue.slot[k]].visible += queue.weight[k];
      }
    }
    queue.packet.count = 0;
  }

  const RayScene& rays_;
  const Patches& patches_;
  std::vector<Sum>& sums_;
  Queue shadow_, first_hit_;
  int64_t cast_ = 0;
};

}  // namespace

VisibleShares ComputeVisibleShares(const RayScene& rays, const Patches& patches, int p,
                                   const std::vector<int>& partial, const Eigen::ArrayXXf& factors,
                                   int rays_per_element) {
  const Patch& patch = patches.patches[static_cast<size_t>(p)];
  const Eigen::Index m = patch.element_count, n = static_cast<Eigen::Index>(partial.size());
  std::vector<Sum> sums(static_cast<size_t>(m * n));
  SightRays sight(rays, patches, sums);
  const auto slot = [&](Eigen::Index e, Eigen::Index k) { return static_cast<size_t>(k * m + e); };
  const auto add = [&](Eigen::Index e, Eigen::Index k, int least) {
    if (factors(e, k) <= 0) return;
    const int wanted =
        std::clamp(static_cast<int>(std::lround(factors(e, k) * static_cast<float>(rays_per_element))), least,
                   kMaxRaysPerPair);
    const int more = wanted - sums[slot(e, k)].count;
    if (more > 0)
      sight.Add(patch.first_element + static_cast<int>(e), partial[static_cast<size_t>(k)], more, slot(e, k));
  };
  const int first =
      (kFirstRaysPerPatchPair + static_cast<int>(m) - 1) / static_cast<int>(std::max<Eigen::Index>(m, 1));
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index e = 0; e < m; ++e) add(e, k, first);
  }
  sight.Flush();
  std::vector<bool> mixed(static_cast<size_t>(n));
  for (Eigen::Index k = 0; k < n; ++k) {
    bool seen = false, hidden = false;
    for (Eigen::Index e = 0; e < m; ++e) {
      seen = seen || sums[slot(e, k)].visible > 0;
      hidden = hidden || sums[slot(e, k)].visible < sums[slot(e, k)].total;
    }
    mixed[static_cast<size_t>(k)] = seen && hidden;
    for (Eigen::Index e = 0; e < m && seen && hidden; ++e) add(e, k, rays_per_element / kMixedShare);
  }
  VisibleShares result{Eigen::ArrayXXf::Ones(m, n), Eigen::ArrayXXf::Zero(m, n), sight.Flush()};
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index e = 0; e < m; ++e) {
      const Sum& sum = sums[slot(e, k)];
      if (sum.total <= 0) continue;
      const float share = sum.visible / sum.total;
      // Rays that all agree are never quite sure (Laplace's rule); where all elements agree, all their rays
      // count.
      const float count = static_cast<float>(mixed[static_cast<size_t>(k)] ? sum.count : sum.count * m);
      const float likely = (share * count + 0.5f) / (count + 1);
      result.share(e, k) = share;
      result.variance(e, k) = likely * (1 - likely) / (count + 1);
    }
  }
  return result;
}

}  // namespace luxfit
