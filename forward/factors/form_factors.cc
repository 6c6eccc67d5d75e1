#include "forward/factors/form_factors.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/factors/internal/disc_rows.h"
#include "forward/factors/internal/pair_rows.h"
#include "forward/factors/internal/ray_rows.h"

namespace luxfit {
namespace {

// Shaft culling compares pairs of facets with each other facet: beyond this many, rays cost less.
constexpr size_t kMaxFacetsForHybrid = 400;

}  // namespace

std::string ToString(FormFactorMethod method) {
  switch (method) {
    case FormFactorMethod::kHybrid:
      return "hybrid";
    case FormFactorMethod::kAnalytic:
      return "analytic";
    case FormFactorMethod::kMalley:
      return "malley";
    case FormFactorMethod::kMalleyStratified:
      return "malley_stratified";
    case FormFactorMethod::kIsocell:
      return "isocell";
    case FormFactorMethod::kMonteCarlo:
      return "montecarlo";
    case FormFactorMethod::kHemicube:
      return "hemicube";
    case FormFactorMethod::kSinglePlane:
      return "single_plane";
    case FormFactorMethod::kWallace:
      return "wallace";
  }
  return "";
}

const std::vector<FormFactorMethod>& AllFormFactorMethods() {
  static const std::vector<FormFactorMethod> all = {
      FormFactorMethod::kHybrid,           FormFactorMethod::kAnalytic,    FormFactorMethod::kMalley,
      FormFactorMethod::kMalleyStratified, FormFactorMethod::kIsocell,     FormFactorMethod::kMonteCarlo,
      FormFactorMethod::kHemicube,         FormFactorMethod::kSinglePlane, FormFactorMethod::kWallace};
  return all;
}

std::optional<FormFactorMethod> FormFactorMethodFrom(const std::string& name) {
  for (const FormFactorMethod method : AllFormFactorMethods()) {
    if (ToString(method) == name) return method;
  }
  return std::nullopt;
}

FormFactors ComputeFormFactors(const RayScene& rays, const Patches& patches,
                               const FormFactorOptions& options) {
  if (options.rays_per_element < 1)
    throw std::invalid_argument("ComputeFormFactors: expected rays_per_element >= 1");
  switch (options.method) {
    case FormFactorMethod::kHybrid:
      if (patches.facets.size() > kMaxFacetsForHybrid) {
        FormFactors result =
            RayFormFactors(rays, patches, FormFactorMethod::kMalley, options.rays_per_element);
        result.because = "hybrid compares facets pair by pair, and there are more than " +
                         std::to_string(kMaxFacetsForHybrid);
        return result;
      }
      return PairFormFactors(rays, patches, options.method, options.rays_per_element);
    case FormFactorMethod::kAnalytic:
      return PairFormFactors(rays, patches, options.method, options.rays_per_element);
    case FormFactorMethod::kWallace:
      return DiscFormFactors(rays, patches, options.rays_per_element);
    default:
      return RayFormFactors(rays, patches, options.method, options.rays_per_element);
  }
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
