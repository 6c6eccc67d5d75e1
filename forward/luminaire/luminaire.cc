#include "forward/luminaire/luminaire.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/luminaire/distribution_ops.h"
#include "forward/room/internal/quadrature.h"

namespace luxfit {

std::string ToString(Distribution distribution) { return OpsOf(distribution).name; }

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
  const DistributionOps& ops = OpsOf(luminaire.distribution);
  if (ops.about_aim == nullptr)
    throw std::invalid_argument("IntensityPerLumen: expected the direction for a measured distribution");
  return ops.about_aim(luminaire, cosine_gamma);
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

Eigen::VectorXd FluxesLm(const std::vector<Luminaire>& luminaires) {
  Eigen::VectorXd flux_lm(static_cast<Eigen::Index>(luminaires.size()));
  std::transform(luminaires.begin(), luminaires.end(), flux_lm.begin(),
                 [](const Luminaire& l) { return l.flux_lm; });
  return flux_lm;
}

bool DependsOnHeading(const Luminaire& luminaire) {
  return luminaire.shape == LuminaireShape::kRectangle ||
         !OpsOf(luminaire.distribution).is_symmetric_about_aim(luminaire);
}

DirectedIntensity IntensityPerLumen(const Luminaire& luminaire, const LuminaireAxes& axes,
                                    const Eigen::Vector3d& direction) {
  return OpsOf(luminaire.distribution).towards(luminaire, axes, direction);
}

}  // namespace luxfit
