// Cosine-weighted rays from an element or a point, and what they meet: see form_factors.h.
#ifndef LUXFIT_FORWARD_INTERNAL_ELEMENT_RAYS_H_
#define LUXFIT_FORWARD_INTERNAL_ELEMENT_RAYS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "forward/patches.h"
#include "forward/visibility.h"

namespace luxfit {

// SplitMix64 (Steele et al. 2014): a well-mixed hash of the receiver's index for the random shift.
inline uint64_t Mix(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

inline double UnitFrom(uint64_t hash) { return static_cast<double>(hash >> 11) * 0x1.0p-53; }

// Points of the 4-D additive recurrence of the generalised golden ratio (x^5 = x + 1), shifted per receiver.
class Sequence {
 public:
  explicit Sequence(uint64_t receiver) {
    uint64_t hash = receiver;
    for (double& s : shift_) s = UnitFrom(hash = Mix(hash));
  }
  Eigen::Vector4d At(int index) const {
    static constexpr double kStep[4] = {0.85667488385450287, 0.73389185662660285, 0.62870672103811578,
                                        0.53859725722361166};
    Eigen::Vector4d point;
    for (int d = 0; d < 4; ++d) {
      const double x = shift_[d] + kStep[d] * (index + 1);
      point[d] = x - std::floor(x);
    }
    return point;
  }

 private:
  double shift_[4];
};

inline Eigen::Vector3d MalleyDirection(double s, double t, const Eigen::Matrix3d& frame) {
  const double radius = std::sqrt(s), angle = 2 * 3.14159265358979323846 * t;
  return frame *
         Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(0.0, 1 - s)));
}

// Columns: two tangents and the normal.
inline Eigen::Matrix3d FrameOf(const Eigen::Vector3d& normal) {
  Eigen::Matrix3d frame;
  frame.col(0) = normal.unitOrthogonal();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  return frame;
}

struct RayTally {
  int64_t escaped = 0, back = 0;
  // A ray that meets a back started on the part of the receiver that is inside a solid: no part of its free
  // share. At least 1.
  int64_t counted = 1;
};

// Calls visit(patch) for every ray that first meets the front of that patch.
template <typename Visit>
RayTally CastRays(const RayScene& rays, const Patches& patches, const Element& receiver, bool triangle,
                  uint64_t seed, int count, const Visit& visit) {
  const Eigen::Matrix3d frame = FrameOf(receiver.normal);
  const Sequence sequence(seed);
  RayTally tally;
  for (int k = 0; k < count; ++k) {
    Eigen::Vector4d x = sequence.At(k);
    if (triangle && x[2] + x[3] > 1) x.tail<2>() = Eigen::Vector2d(1 - x[2], 1 - x[3]);
    const Eigen::Vector3d origin = receiver.origin + x[2] * receiver.edge_u + x[3] * receiver.edge_v;
    const RayHit hit = rays.Trace(LiftedOff(origin, receiver.normal), MalleyDirection(x[0], x[1], frame));
    if (hit.facet < 0) {
      ++tally.escaped;
    } else if (!hit.front) {
      ++tally.back;
    } else if (const int element = patches.ElementAt(hit.facet, hit.u, hit.v); element >= 0) {
      visit(patches.elements[static_cast<size_t>(element)].patch);
    }
  }
  tally.counted = std::max<int64_t>(1, count - tally.back);
  return tally;
}

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_INTERNAL_ELEMENT_RAYS_H_
