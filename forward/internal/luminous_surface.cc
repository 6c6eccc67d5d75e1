#include "forward/internal/luminous_surface.h"

#include <cmath>

namespace luxfit {
namespace {

constexpr double kPi = 3.14159265358979323846;

}  // namespace

Eigen::Vector3d SurfacePointAt(const Luminaire& luminaire, const LuminaireAxes& axes,
                               const Eigen::Vector2d& unit) {
  if (luminaire.shape == LuminaireShape::kRectangle) {
    return luminaire.position + (unit[0] - 0.5) * luminaire.size_m[0] * axes.along +
           (unit[1] - 0.5) * luminaire.size_m[1] * axes.across;
  }
  if (luminaire.shape == LuminaireShape::kDisc) {
    const double radius = 0.5 * luminaire.size_m[0] * std::sqrt(unit[0]), angle = 2 * kPi * unit[1];
    return luminaire.position + radius * (std::cos(angle) * axes.along + std::sin(angle) * axes.across);
  }
  return luminaire.position;
}

}  // namespace luxfit
