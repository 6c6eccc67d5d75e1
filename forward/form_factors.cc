#include "forward/form_factors.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cstdint>
#include <stdexcept>

#include "forward/internal/element_rays.h"

namespace luxfit {
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
          auto row = result.element_to_patch.row(e);
          const RayTally tally =
              CastRays(rays, patches, element, triangle, static_cast<uint64_t>(e), options.rays_per_element,
                       [&row](int patch) { row[patch] += 1.0f; });
          row /= static_cast<float>(tally.counted);
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
  const RayTally tally =
      CastRays(rays, patches, point, false, 0, ray_count, [&row](int patch) { row[patch] += 1.0f; });
  return row / static_cast<float>(tally.counted);
}

}  // namespace luxfit
