#include "forward/direct/internal/luminous_surface.h"

#include <cmath>

namespace luxfit {
namespace {

Eigen::Vector2d SidesOf(const Luminaire& luminaire) {
  if (luminaire.shape == LuminaireShape::kRectangle) return luminaire.size_m;
  return Eigen::Vector2d::Constant(luminaire.shape == LuminaireShape::kDisc ? luminaire.size_m[0] : 0);
}

}  // namespace

LuminousSurface::LuminousSurface(const Luminaire& luminaire)
    : luminaire_(&luminaire),
      towards_(OpsOf(luminaire.distribution).towards),
      axes_(AxesOf(luminaire)),
      sides_(SidesOf(luminaire)) {}

Eigen::Vector2d LuminousSurface::PlaceAt(const Eigen::Vector2d& unit) const {
  if (!is_disc()) return unit.array() - 0.5;
  const double radius = 0.5 * std::sqrt(unit[0]), angle = 2 * M_PI * unit[1];
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

std::vector<Eigen::Vector2d> LuminousSurface::Outline(int pieces_a_side) const {
  std::vector<Eigen::Vector2d> outline;
  const int n = pieces_a_side;
  outline.reserve(static_cast<size_t>(is_disc() ? 8 : 4) * static_cast<size_t>(n));
  for (int k = 0; is_disc() && k < 8 * n; ++k)
    outline.emplace_back(0.5 * std::cos(2 * M_PI * k / (8 * n)), 0.5 * std::sin(2 * M_PI * k / (8 * n)));
  const Eigen::Vector2d corners[5] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}, {-0.5, -0.5}};
  for (int side = 0; !is_disc() && side < 4; ++side) {
    for (int k = 0; k < n; ++k)
      outline.push_back(corners[side] + static_cast<double>(k) / n * (corners[side + 1] - corners[side]));
  }
  return outline;
}

double LuminousSurface::area_m2() const { return is_disc() ? M_PI / 4 * sides_.prod() : sides_.prod(); }

}  // namespace luxfit
