#include "forward/form_factors.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace luxfit {
namespace {

constexpr double kPi = 3.14159265358979323846;

// SplitMix64 (Steele et al. 2014): a well-mixed hash of the receiver's index for the random shift.
uint64_t Mix(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

double UnitFrom(uint64_t hash) { return static_cast<double>(hash >> 11) * 0x1.0p-53; }

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

Eigen::Vector3d MalleyDirection(double s, double t, const Eigen::Matrix3d& frame) {
  const double radius = std::sqrt(s), angle = 2 * kPi * t;
  return frame *
         Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(0.0, 1 - s)));
}

// Columns: two tangents and the normal.
Eigen::Matrix3d FrameOf(const Eigen::Vector3d& normal) {
  Eigen::Matrix3d frame;
  frame.col(0) = normal.unitOrthogonal();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  return frame;
}

struct RayTally {
  int64_t escaped = 0, back = 0;
};

template <typename Row>
RayTally CastRays(const RayScene& rays, const Patches& patches, const Element& receiver, bool triangle,
                  uint64_t seed, int count, Row&& row) {
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
      row[patches.elements[static_cast<size_t>(element)].patch] += 1.0f;
    }
  }
  // A ray that meets a back started on the part of the receiver that is inside a solid: no part of its free
  // share.
  row /= static_cast<float>(std::max<int64_t>(1, count - tally.back));
  return tally;
}

}  // namespace

FormFactors ComputeFormFactors(const RayScene& rays, const Patches& patches,
                               const FormFactorOptions& options) {
  if (options.rays_per_element < 1)
    throw std::invalid_argument("ComputeFormFactors: expected rays_per_element >= 1");
  const Eigen::Index n = static_cast<Eigen::Index>(patches.elements.size());
  FormFactors result;
  result.element_to_patch.setZero(n, static_cast<Eigen::Index>(patches.patches.size()));
  std::atomic<int64_t> escaped{0}, back{0};
  tbb::parallel_for(
      tbb::blocked_range<Eigen::Index>(0, n, 64), [&](const tbb::blocked_range<Eigen::Index>& range) {
        RayTally sum;
        for (Eigen::Index e = range.begin(); e < range.end(); ++e) {
          const Element& element = patches.elements[static_cast<size_t>(e)];
          const int facet = patches.patches[static_cast<size_t>(element.patch)].facet;
          const bool triangle = patches.kinds[static_cast<size_t>(facet)] == FacetKind::kTriangle;
          const RayTally tally = CastRays(rays, patches, element, triangle, static_cast<uint64_t>(e),
                                          options.rays_per_element, result.element_to_patch.row(e));
          sum.escaped += tally.escaped;
          sum.back += tally.back;
        }
        escaped += sum.escaped;
        back += sum.back;
      });
  const double total = static_cast<double>(n) * options.rays_per_element;
  result.escaped_fraction = static_cast<double>(escaped) / total;
  result.back_fraction = static_cast<double>(back) / total;
  return result;
}

Eigen::VectorXf SensorFormFactors(const RayScene& rays, const Patches& patches,
                                  const Eigen::Vector3d& p_in_world, const Eigen::Vector3d& normal,
                                  int ray_count) {
  Element point;
  point.normal = normal;
  point.origin = p_in_world;
  point.edge_u.setZero();
  point.edge_v.setZero();
  Eigen::VectorXf row = Eigen::VectorXf::Zero(static_cast<Eigen::Index>(patches.patches.size()));
  CastRays(rays, patches, point, false, 0, ray_count, row);
  return row;
}

}  // namespace luxfit
