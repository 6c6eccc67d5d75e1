#include "forward/factors/internal/ray_rows.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <atomic>
#include <cmath>
#include <stdexcept>

#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

// Columns: two tangents, turned about the normal, and the normal.
Eigen::Matrix3f FrameOf(const Element& receiver, double turn) {
  const Eigen::Vector3d along =
      receiver.edge_u.squaredNorm() > 0 ? receiver.edge_u.normalized() : receiver.normal.unitOrthogonal();
  const Eigen::Vector3d across = receiver.normal.cross(along);
  const double c = std::cos(2 * M_PI * turn), s = std::sin(2 * M_PI * turn);
  Eigen::Matrix3d frame;
  frame << c * along + s * across, c * across - s * along, receiver.normal;
  return frame.cast<float>();
}

// Points spread over a receiver: dimensions 3 and 4 of the recurrence in malley.cc, shifted per receiver.
class Origins {
 public:
  Origins(const Element& receiver, bool triangle, bool center, uint64_t hash)
      : base_(LiftedOff(center ? receiver.center : receiver.origin, receiver.normal).cast<float>()),
        edge_u_((center ? 0 : 1) * receiver.edge_u.cast<float>()),
        edge_v_((center ? 0 : 1) * receiver.edge_v.cast<float>()),
        triangle_(triangle),
        u_(UnitFrom(Mix(hash))),
        v_(UnitFrom(Mix(hash + 1))) {}

  Eigen::Vector3f Next() {
    u_ += kGoldenSteps[2];
    v_ += kGoldenSteps[3];
    u_ -= u_ >= 1 ? 1 : 0;
    v_ -= v_ >= 1 ? 1 : 0;
    const bool mirrored = triangle_ && u_ + v_ > 1;
    const float u = static_cast<float>(mirrored ? 1 - u_ : u_),
                v = static_cast<float>(mirrored ? 1 - v_ : v_);
    return base_ + u * edge_u_ + v * edge_v_;
  }

 private:
  Eigen::Vector3f base_, edge_u_, edge_v_;
  bool triangle_;
  double u_, v_;
};

}  // namespace

RayRows::RayRows(const RayScene& rays, const Patches& patches, FormFactorMethod method, int count)
    : rays_(rays), patches_(patches), ops_(OpsOf(method)), count_(count) {
  if (!ops_.directions)
    throw std::invalid_argument("RayRows: " + ToString(method) + " casts no rays over a hemisphere");
  for (const Element& element : patches.elements) patch_of_element_.push_back(element.patch);
  for (int set = 0; set < ops_.direction_sets; ++set)
    sets_.push_back(ops_.directions(count, static_cast<uint64_t>(set)));
}

RayTally RayRows::Cast(const Element& receiver, uint64_t index, float* row) const {
  const RayTally tally = Trace(receiver, index, [row](int patch, float weight) { row[patch] += weight; });
  if (tally.scale != 1) {
    Eigen::Map<Eigen::VectorXf>(row, static_cast<Eigen::Index>(patches_.patches.size())) *=
        static_cast<float>(tally.scale);
  }
  return tally;
}

RayTally RayRows::Cast(const Element& receiver, uint64_t index, const HitSink& add) const {
  return Trace(receiver, index, add);
}

template <typename Add>
RayTally RayRows::Trace(const Element& receiver, uint64_t index, const Add& add) const {
  const uint64_t hash = Mix(index);
  Directions fresh;
  if (sets_.empty()) fresh = ops_.directions(count_, hash);
  const Directions& set = sets_.empty() ? fresh : sets_[hash % sets_.size()];
  const Eigen::Matrix3f frame = FrameOf(receiver, ops_.is_from_center ? 0 : UnitFrom(Mix(hash + 2)));
  const bool triangle = receiver.patch >= 0 && patches_.IsTriangle(receiver.patch);
  Origins origins(receiver, triangle, ops_.is_from_center, hash);
  RayTally tally;
  for (Eigen::Index first = 0; first < set.unit.cols(); first += RayPacket::kSize) {
    RayPacket packet;
    for (Eigen::Index k = first; k < std::min<Eigen::Index>(first + RayPacket::kSize, set.unit.cols()); ++k) {
      packet.Add(origins.Next(), frame * set.unit.col(k));
    }
    const PacketHits hits = rays_.Trace(packet);
    for (int k = 0; k < packet.count; ++k) {
      const float weight = set.weight[first + k];
      if (hits.facet[k] < 0) {
        tally.escaped += weight;
        continue;
      }
      // What has been left out of the elements lies inside solids: so did the ray's start.
      const int element = hits.front[k] ? patches_.ElementAt(hits.facet[k], hits.u[k], hits.v[k]) : -1;
      if (element < 0) {
        tally.back += weight;
      } else {
        add(patch_of_element_[static_cast<size_t>(element)], weight);
        tally.landed += weight;
      }
    }
  }
  tally.rays = set.unit.cols();
  // A ray that meets a back started on the part of the receiver that is inside a solid: no part of its free
  // share.
  const double counted = tally.landed + tally.escaped;
  if (tally.back > 0 && counted > 0) {
    tally.scale = (counted + tally.back) / counted;
    tally.landed *= tally.scale;
    tally.escaped *= tally.scale;
  }
  return tally;
}

RayTally Summarise(const std::vector<RayTally>& tallies) {
  RayTally sum;
  double seeing = 0;
  for (const RayTally& tally : tallies) {
    sum.rays += tally.rays;
    sum.back += tally.back;
    if (tally.SeesNothing()) continue;
    seeing += 1;
    sum.escaped += tally.escaped;
  }
  sum.escaped /= std::max(1.0, seeing);
  sum.back /= std::max<double>(1, static_cast<double>(tallies.size()));
  return sum;
}

FormFactors RayFormFactors(const RayScene& rays, const Patches& patches, FormFactorMethod method, int count) {
  const RayRows rows(rays, patches, method, count);
  const Eigen::Index n = static_cast<Eigen::Index>(patches.elements.size());
  FormFactors result;
  result.method = method;
  // Zeroed row by row below: a serial pass over the pages would cost a fifth of the time.
  result.element_to_patch.resize(n, static_cast<Eigen::Index>(patches.patches.size()));
  std::vector<RayTally> tallies(static_cast<size_t>(n));
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, n, 64),
                    [&](const tbb::blocked_range<Eigen::Index>& range) {
                      for (Eigen::Index e = range.begin(); e < range.end(); ++e) {
                        result.element_to_patch.row(e).setZero();
                        tallies[static_cast<size_t>(e)] =
                            rows.Cast(patches.elements[static_cast<size_t>(e)], static_cast<uint64_t>(e),
                                      result.element_to_patch.row(e).data());
                      }
                    });
  const RayTally all = Summarise(tallies);
  result.escaped_fraction = all.escaped;
  result.back_fraction = all.back;
  result.rays = all.rays;
  double gaps = 0, seeing = 0;
  for (const RayTally& tally : tallies) {
    if (tally.SeesNothing()) continue;
    seeing += 1;
    gaps += std::pow(tally.landed - 1, 2);
  }
  if (all.escaped == 0 && seeing > 0) result.closure_error = std::sqrt(gaps / seeing);
  return result;
}

}  // namespace luxfit
