#include "forward/direct/internal/surface_rule.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "forward/luminaire/distribution_ops.h"

namespace luxfit {
namespace {

constexpr int kMaxOrder = 24;

// A lobe cos^m is 1 / sqrt(m) wide. Where the receiver's plane cuts the surface, the integrand has a kink.
int OrderFor(const LuminousSurface& surface, const Eigen::Vector3d& p, bool is_cut) {
  const double distance = std::max((p - surface.luminaire().position).norm(), 1e-3);
  const Luminaire& luminaire = surface.luminaire();
  const double order = std::ceil(2 + 2 * std::sqrt(OpsOf(luminaire.distribution).sharpness(luminaire) + 3) *
                                         surface.sides().maxCoeff() / distance) *
                       (is_cut ? 3 : 1);
  return order < kMaxOrder ? static_cast<int>(order) : kMaxOrder;  // NaN too
}

}  // namespace

const std::vector<SurfaceSample>& SurfaceRule(LuminaireShape shape, int order) {
  using Rules = std::array<std::vector<SurfaceSample>, kMaxOrder + 1>;
  static const auto make = [](LuminaireShape s) {
    Rules rules;
    for (int n = 1; n <= kMaxOrder; ++n) rules[static_cast<size_t>(n)] = SampleSurface(s, n);
    return rules;
  };
  static const Rules rectangle = make(LuminaireShape::kRectangle), disc = make(LuminaireShape::kDisc);
  static const std::vector<SurfaceSample> point = SampleSurface(LuminaireShape::kPoint, 1);
  const auto at = static_cast<size_t>(std::min(order, kMaxOrder));
  if (shape == LuminaireShape::kRectangle) return rectangle[at];
  if (shape == LuminaireShape::kDisc) return disc[at];
  return point;
}

const std::vector<SurfaceSample>& SurfaceRuleFor(const LuminousSurface& surface, const Eigen::Vector3d& p,
                                                 const Eigen::Vector3d& normal) {
  static const std::vector<SurfaceSample> none;
  const Luminaire& luminaire = surface.luminaire();
  const LuminaireAxes& axes = surface.axes();
  const double height_of_centre = normal.dot(luminaire.position - p);
  const double reach = 0.5 * (std::abs(surface.sides()[0] * normal.dot(axes.along)) +
                              std::abs(surface.sides()[1] * normal.dot(axes.across)));
  if (height_of_centre < -reach) return none;
  return SurfaceRule(luminaire.shape,
                     surface.has_extent() ? OrderFor(surface, p, height_of_centre < reach) : 1);
}

}  // namespace luxfit
