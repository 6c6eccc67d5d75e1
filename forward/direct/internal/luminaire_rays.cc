#include "forward/direct/internal/luminaire_rays.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/direct/internal/cell_sum.h"
#include "forward/direct/internal/luminous_surface.h"
#include "forward/luminaire/distribution_ops.h"
#include "forward/luminaire/internal/expect_luminaire.h"
#include "forward/luminaire/internal/tabulated.h"
#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

// Returns the unit vector at gamma from the aim and C from the heading.
Eigen::Vector3d DirectionAt(const Luminaire& luminaire, const LuminaireAxes& axes, double gamma, double c) {
  return std::cos(gamma) * luminaire.aim +
         std::sin(gamma) * (std::cos(c) * axes.along + std::sin(c) * axes.across);
}

// Returns the mean of the intensity around the aim.
double MeanIntensity(const Luminaire& luminaire, const LuminaireAxes& axes, double gamma) {
  const DistributionOps& ops = OpsOf(luminaire.distribution);
  const int turns = ops.about_aim == nullptr ? 72 : 1;
  double sum = 0;
  for (int k = 0; k < turns; ++k)
    sum += ops.towards(luminaire, axes, DirectionAt(luminaire, axes, gamma, 2 * M_PI * (k + 0.5) / turns))
               .cd_per_lm;
  return sum / turns;
}

// Maps the unit square onto the surface with the density of its emission.
Eigen::Vector2d EmittingPlaceAt(const LuminousSurface& surface, Eigen::Vector2d unit) {
  const Eigen::ArrayXXd& emission = surface.luminaire().emission;
  if (!HasUnevenEmission(surface.luminaire())) return surface.PlaceAt(unit);
  // Column by column: the cell in whose part of [0, 1] the first coordinate falls.
  const double* share = emission.data();
  Eigen::Index cell = 0;
  while (cell + 1 < emission.size() && unit[0] >= share[cell]) unit[0] -= share[cell++];
  const Eigen::Vector2d within(share[cell] > 0 ? std::min(unit[0] / share[cell], 1.0) : 0.5, unit[1]);
  const Eigen::Index row = cell % emission.rows(), column = cell / emission.rows();
  const Eigen::Vector2d index(static_cast<double>(row), static_cast<double>(column));
  const Eigen::Array2d counts(static_cast<double>(emission.rows()), static_cast<double>(emission.cols()));
  return (index + within).array() / counts - 0.5;
}

}  // namespace

LuminaireRays SampleDistribution(const Luminaire& luminaire, int ray_count) {
  if (ray_count < 1) throw std::invalid_argument("SampleDistribution: expected ray_count >= 1");
  ExpectValid(luminaire);
  const LuminaireAxes axes = AxesOf(luminaire);
  const Tabulated polar(
      0, M_PI, [&](double gamma) { return MeanIntensity(luminaire, axes, gamma) * std::sin(gamma); });
  const std::vector<Eigen::Vector2d> cells = Isocell(ray_count);
  LuminaireRays rays;
  rays.directions.resize(3, static_cast<Eigen::Index>(cells.size()));
  rays.share.resize(rays.directions.cols());
  for (Eigen::Index k = 0; k < rays.directions.cols(); ++k) {
    const Eigen::Vector2d& cell = cells[static_cast<size_t>(k)];
    const double gamma = polar.Quantile(cell[0]);
    rays.directions.col(k) = DirectionAt(luminaire, axes, gamma, 2 * M_PI * cell[1]);
    const double mean = MeanIntensity(luminaire, axes, gamma);
    const double here = IntensityPerLumen(luminaire, axes, rays.directions.col(k)).cd_per_lm;
    rays.share[k] = mean > 0 ? here / mean : 0;
  }
  rays.share /= rays.share.sum();
  return rays;
}

Eigen::VectorXf LuminaireFormFactors(const RayScene& rays, const Patches& patches, const Luminaire& luminaire,
                                     int ray_count) {
  const LuminaireRays sample = SampleDistribution(luminaire, ray_count);
  const LuminousSurface surface(luminaire);
  Eigen::VectorXf row = Eigen::VectorXf::Zero(static_cast<Eigen::Index>(patches.patches.size()));
  for (Eigen::Index k = 0; k < sample.directions.cols(); ++k) {
    // The plastic number's recurrence spreads the starts over the surface.
    const double n = static_cast<double>(k + 1);
    const Eigen::Vector3d start = surface.PointOf(
        EmittingPlaceAt(surface, {Fraction(0.75487766624669276 * n), Fraction(0.56984029099805327 * n)}));
    const RayHit hit = rays.Trace(start, sample.directions.col(k));
    if (hit.facet < 0 || !hit.front) continue;
    if (const int element = patches.ElementAt(hit.facet, hit.u, hit.v); element >= 0)
      row[patches.elements[static_cast<size_t>(element)].patch] += static_cast<float>(sample.share[k]);
  }
  return row;
}

}  // namespace luxfit
