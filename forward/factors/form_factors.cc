#include "forward/factors/form_factors.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/factors/internal/ray_rows.h"

namespace luxfit {

std::string ToString(FormFactorMethod method) { return OpsOf(method).name; }

std::optional<FormFactorMethod> FormFactorMethodFrom(const std::string& name) {
  for (const FormFactorOps& ops : FormFactorMethods()) {
    if (ops.name == name) return ops.method;
  }
  return std::nullopt;
}

FormFactors ComputeFormFactors(const RayScene& rays, const Patches& patches,
                               const FormFactorOptions& options) {
  if (options.rays_per_element < 1)
    throw std::invalid_argument("ComputeFormFactors: expected rays_per_element >= 1");
  const FormFactorOps& ops = OpsOf(options.method);
  return ops.by_pairs ? ops.by_pairs(rays, patches, options.rays_per_element)
                      : RayFormFactors(rays, patches, options.method, options.rays_per_element);
}

RayShares RaySharesOf(const FormFactors& form_factors) {
  const Eigen::VectorXf kept = form_factors.element_to_patch.rowwise().sum();
  const Eigen::Index inside = (kept.array() > 0).count();
  const double missing = inside == 0 ? 1 : 1 - kept.cast<double>().sum() / static_cast<double>(inside);
  // Rows also miss what falls on the free rims of elements that are nearly all inside a solid.
  return {std::min(missing, form_factors.escaped_fraction), form_factors.back_fraction};
}

double ReciprocityError(const Patches& patches, const FormFactors& form_factors) {
  const Eigen::Index n = static_cast<Eigen::Index>(patches.patches.size());
  Eigen::MatrixXd flow = Eigen::MatrixXd::Zero(n, n);
  for (size_t e = 0; e < patches.elements.size(); ++e) {
    const Element& element = patches.elements[e];
    flow.row(element.patch) +=
        element.area_m2 * form_factors.element_to_patch.row(static_cast<Eigen::Index>(e)).cast<double>();
  }
  const double size = flow.norm();
  return size > 0 ? (flow - flow.transpose()).norm() / size : 0;
}

}  // namespace luxfit
