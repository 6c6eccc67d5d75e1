#include "forward/direct/internal/surface_rule.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "forward/luminaire/distribution_ops.h"
#include "forward/room/internal/quadrature.h"

namespace luxfit {
namespace {

constexpr int kMaxOrder = 24;

// Returns the orders along and across. A lobe cos^m is 1 / sqrt(m) wide. Where the receiver's plane cuts the surface,
// the integrand has a kink.
std::array<int, 2> OrdersFor(const LuminousSurface& surface, const Eigen::Vector3d& p, bool is_cut) {
  const double distance = std::max((p - surface.luminaire().position).norm(), 1e-3);
  const Luminaire& luminaire = surface.luminaire();
  const double per_m = 2 * std::sqrt(OpsOf(luminaire.distribution).sharpness(luminaire) + 3) / distance;
  const auto order = [&](double side) {
    const double n = std::ceil(1 + per_m * side) * (is_cut ? 3 : 1);
    return n < kMaxOrder ? static_cast<int>(n) : kMaxOrder;  // NaN too
  };
  return {order(surface.sides()[0]), order(surface.sides()[1])};
}

using RulesByOrder = std::array<std::vector<SurfaceSample>, kMaxOrder + 1>;

// Returns the products of Gauss-Legendre rules, by order along and across.
std::array<RulesByOrder, kMaxOrder + 1> RectangleRules() {
  std::array<RulesByOrder, kMaxOrder + 1> rules;
  for (int n = 1; n <= kMaxOrder; ++n) {
    for (int m = 1; m <= kMaxOrder; ++m) {
      std::vector<SurfaceSample>& rule = rules[static_cast<size_t>(n)][static_cast<size_t>(m)];
      for (const LineNode& a : GaussLegendre(n))
        for (const LineNode& b : GaussLegendre(m))
          rule.push_back({a.t - 0.5, b.t - 0.5, a.weight * b.weight});
    }
  }
  return rules;
}

RulesByOrder DiscRules() {
  RulesByOrder rules;
  for (int n = 1; n <= kMaxOrder; ++n)
    rules[static_cast<size_t>(n)] = SampleSurface(LuminaireShape::kDisc, n);
  return rules;
}

}  // namespace

const std::vector<SurfaceSample>& SurfaceRule(LuminaireShape shape, int along, int across) {
  static const std::array<RulesByOrder, kMaxOrder + 1> rectangle = RectangleRules();
  static const RulesByOrder disc = DiscRules();
  static const std::vector<SurfaceSample> point = SampleSurface(LuminaireShape::kPoint, 1);
  const auto n = static_cast<size_t>(std::min(along, kMaxOrder));
  if (shape == LuminaireShape::kRectangle)
    return rectangle[n][static_cast<size_t>(std::min(across, kMaxOrder))];
  if (shape == LuminaireShape::kDisc) return disc[n];
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
  if (!surface.has_extent()) return SurfaceRule(luminaire.shape, 1, 1);
  const auto [along, across] = OrdersFor(surface, p, height_of_centre < reach);
  return SurfaceRule(luminaire.shape, along, across);
}

}  // namespace luxfit
