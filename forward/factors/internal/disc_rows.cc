// Form factors by Wallace's disc approximation, cast from the receiver.
//
//   F_ej = sum_k V_k cos cos' A_k / (pi r_k^2 + A_k)
//
// from the element's centre to pieces of patch j, each taken for a disc of its area A_k, a shadow ray to its
// centre. The rays of an element are shared out evenly over the patches, one a patch at least.
//
// Source: Wallace, Elmquist, Haines (1989), "A ray tracing algorithm for progressive radiosity", eq. 9.
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "forward/factors/internal/methods.h"
#include "forward/room/internal/quadrature.h"

namespace luxfit {
namespace {

FormFactors DiscFormFactors(const RayScene& rays, const Patches& patches, int rays_per_element) {
  const size_t n = patches.patches.size();
  const int pieces = std::max(
      1, static_cast<int>(std::lround(rays_per_element / std::max<double>(1, static_cast<double>(n)))));
  const int order = std::max(1, static_cast<int>(std::lround(std::sqrt(pieces))));
  FormFactors result;
  result.method = FormFactorMethod::kWallace;
  result.element_to_patch.setZero(static_cast<Eigen::Index>(patches.elements.size()),
                                  static_cast<Eigen::Index>(n));
  tbb::parallel_for(size_t{0}, patches.elements.size(), [&](size_t e) {
    const Element& element = patches.elements[e];
    const Eigen::Vector3d from = LiftedOff(element.center, element.normal);
    for (size_t j = 0; j < n; ++j) {
      const Patch& patch = patches.patches[j];
      const Facet& facet = patches.facets[static_cast<size_t>(patch.facet)];
      const Eigen::Vector3d normal = facet.Normal();
      double sum = 0;
      for (const FacetNode& node : FacetRule(facet.kind, order)) {
        const Eigen::Vector3d to = patch.origin + node.u * patch.edge_u + node.v * patch.edge_v,
                              d = to - element.center;
        const double here = element.normal.dot(d), there = -normal.dot(d), r2 = d.squaredNorm();
        if (here <= 0 || there <= 0 || rays.Occluded(from, to)) continue;
        const double area = node.weight * patch.area_m2;
        sum += here * there / r2 * area / (M_PI * r2 + area);
      }
      result.element_to_patch(static_cast<Eigen::Index>(e), static_cast<Eigen::Index>(j)) =
          static_cast<float>(sum);
    }
  });
  result.rays = static_cast<int64_t>(patches.elements.size()) * static_cast<int64_t>(n) * order * order;
  return result;
}

}  // namespace

FormFactorOps WallaceMethod() {
  FormFactorOps ops;
  ops.method = FormFactorMethod::kWallace;
  ops.name = "wallace";
  ops.is_from_center = true;
  ops.by_pairs = DiscFormFactors;
  return ops;
}

}  // namespace luxfit
