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

// Returns the points that a side needs in place of the closed form, by its squared distance in sides; 0: it is too near.
int FarOrderFor(double sides_away2) {
  if (sides_away2 > 8 * 8) return 2;
  if (sides_away2 > 3 * 3) return 3;
  return sides_away2 > 1.7 * 1.7 ? 4 : 0;
}

// Returns how far the surface reaches to either side of its centre along a normal, m.
double ReachAlong(const LuminousSurface& surface, const Eigen::Vector3d& normal) {
  return 0.5 * (std::abs(surface.sides()[0] * normal.dot(surface.axes().along)) +
                std::abs(surface.sides()[1] * normal.dot(surface.axes().across)));
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
  const double height_of_centre = normal.dot(luminaire.position - p);
  const double reach = ReachAlong(surface, normal);
  if (height_of_centre < -reach) return none;
  if (!surface.has_extent()) return SurfaceRule(luminaire.shape, 1, 1);
  const auto [along, across] = OrdersFor(surface, p, height_of_centre < reach);
  return SurfaceRule(luminaire.shape, along, across);
}

const std::vector<SurfaceSample>* FarRuleFor(const LuminousSurface& surface, const Eigen::Vector3d& p,
                                             const Eigen::Vector3d& normal) {
  if (surface.is_disc()) return nullptr;
  const Eigen::Vector3d to_centre = surface.luminaire().position - p;
  const Eigen::Array2d away2 = to_centre.squaredNorm() / surface.sides().array().square();
  const int along = FarOrderFor(away2[0]), across = FarOrderFor(away2[1]);
  // NaN is not far: it is left to the closed form.
  if (along == 0 || across == 0 || !(normal.dot(to_centre) > ReachAlong(surface, normal))) return nullptr;
  return &SurfaceRule(LuminaireShape::kRectangle, along, across);
}

}  // namespace luxfit
