#include "forward/luminaire/luminaire.h"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "forward/luminaire/photometry.h"
#include "forward/room/internal/quadrature.h"

namespace luxfit {
namespace {}  // namespace

std::string ToString(Distribution distribution) {
  switch (distribution) {
    case Distribution::kIsotropic:
      return "isotropic";
    case Distribution::kLambertian:
      return "lambertian";
    case Distribution::kCosinePower:
      return "cosine_power";
    case Distribution::kMeasured:
      return "measured";
  }
  return "";
}

std::string ToString(LuminaireShape shape) {
  switch (shape) {
    case LuminaireShape::kPoint:
      return "point";
    case LuminaireShape::kDisc:
      return "disc";
    case LuminaireShape::kRectangle:
      return "rectangle";
    case LuminaireShape::kSphere:
      return "sphere";
  }
  return "";
}

Intensity IntensityPerLumen(const Luminaire& luminaire, double cosine_gamma) {
  if (luminaire.distribution == Distribution::kIsotropic) return {1 / (4 * M_PI), 0, 0};
  if (luminaire.distribution == Distribution::kMeasured)
    throw std::invalid_argument("IntensityPerLumen: expected the direction for a measured distribution");
  if (cosine_gamma <= 0) return {};
  if (luminaire.distribution == Distribution::kLambertian) return {cosine_gamma / M_PI, 1 / M_PI, 0};
  const double m = luminaire.cosine_exponent;
  const double log_cosine = std::log(cosine_gamma);
  const double lobe = std::exp(m * log_cosine) / (2 * M_PI);
  return {(m + 1) * lobe, (m + 1) * m * lobe / cosine_gamma, lobe * (1 + (m + 1) * log_cosine)};
}

std::vector<SurfaceSample> SampleSurface(LuminaireShape shape, int order) {
  if (order < 1) throw std::invalid_argument("SampleSurface: expected order >= 1");
  std::vector<SurfaceSample> samples;
  if (shape == LuminaireShape::kRectangle) {
    for (const FacetNode& node : FacetRule(FacetKind::kParallelogram, order)) {
      samples.push_back({node.u - 0.5, node.v - 0.5, node.weight});
    }
  } else if (shape == LuminaireShape::kDisc) {
    // Radius by Gauss-Legendre in r^2 (equal area), angle by the trapezoidal rule, exact for trigonometric
    // polynomials.
    const int spokes = 2 * order + 1;
    for (const LineNode& node : GaussLegendre(order)) {
      const double radius = 0.5 * std::sqrt(node.t);
      for (int k = 0; k < spokes; ++k) {
        const double angle = 2 * M_PI * k / spokes;
        samples.push_back({radius * std::cos(angle), radius * std::sin(angle), node.weight / spokes});
      }
    }
  } else {
    samples.push_back({});
  }
  return samples;
}

LuminaireAxes AxesOf(const Luminaire& luminaire) {
  Eigen::Vector3d along = luminaire.heading - luminaire.heading.dot(luminaire.aim) * luminaire.aim;
  // A heading along the aim says nothing: take any perpendicular.
  if (along.norm() < 1e-6) along = luminaire.aim.unitOrthogonal();
  along.normalize();
  return {along, luminaire.aim.cross(along)};
}

DirectedIntensity IntensityPerLumen(const Luminaire& luminaire, const LuminaireAxes& axes,
                                    const Eigen::Vector3d& direction) {
  const double cosine_gamma = luminaire.aim.dot(direction);
  if (luminaire.distribution != Distribution::kMeasured) {
    const Intensity intensity = IntensityPerLumen(luminaire, cosine_gamma);
    return {intensity.cd_per_lm, intensity.d_cosine * luminaire.aim, intensity.d_exponent};
  }
  if (!luminaire.table) throw std::invalid_argument("IntensityPerLumen: expected a table, got none");
  // C runs from the heading away from `across`: x along, y = -across, z = -aim.
  const TableIntensity at = IntensityTowards(
      *luminaire.table, {axes.along.dot(direction), -axes.across.dot(direction), -cosine_gamma});
  return {
      at.cd_per_lm,
      at.d_direction.x() * axes.along - at.d_direction.y() * axes.across - at.d_direction.z() * luminaire.aim,
      0};
}

}  // namespace luxfit
