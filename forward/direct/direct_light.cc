#include "forward/direct/direct_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "forward/direct/internal/cell_sum.h"
#include "forward/direct/internal/lobe_sum.h"
#include "forward/direct/internal/luminous_surface.h"
#include "forward/direct/internal/surface_rule.h"
#include "forward/factors/internal/disc_factor.h"
#include "forward/factors/internal/polygon_factor.h"
#include "forward/luminaire/distribution_ops.h"

namespace luxfit {
namespace {

ConvexPolygon PolygonOf(const LuminousSurface& rectangle) {
  return MakePolygon(rectangle.PointOf({-0.5, -0.5}), rectangle.sides()[0] * rectangle.axes().along,
                     rectangle.sides()[1] * rectangle.axes().across, FacetKind::kParallelogram);
}

// Returns E = pi L F, L = Phi / (pi A), with F in closed form.
DirectIlluminance LambertianRectangle(const LuminousSurface& surface, const Eigen::Vector3d& p,
                                      const Eigen::Vector3d& normal) {
  const PolygonGradient factor = PointToPolygonGradient(p, normal, PolygonOf(surface));
  const double area = surface.area_m2();
  DirectIlluminance sum;
  sum.lx_per_lm = factor.factor / area;
  const Eigen::Vector2d corners[4] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  // A Lambertian lobe adds nothing of its own to a turn: it is the cosine of the surface.
  for (size_t k = 0; k < 4; ++k) surface.AddMotion(corners[k], factor.d_vertex[k] / area, sum);
  sum.d_size -= sum.lx_per_lm * surface.sides().cwiseInverse();
  return sum;
}

DirectIlluminance LambertianDisc(const LuminousSurface& surface, const Eigen::Vector3d& p,
                                 const Eigen::Vector3d& normal) {
  const Luminaire& luminaire = surface.luminaire();
  const double diameter = surface.sides()[0], area = surface.area_m2();
  const DiscFactor disc = PointToDisc(p, normal, luminaire.position, luminaire.aim, diameter / 2);
  DirectIlluminance sum;
  sum.lx_per_lm = disc.factor / area;
  sum.d_position = disc.d_center / area;
  // To turn the luminaire is to turn centre and receiver's normal about the receiver the other way.
  const Eigen::Vector3d turn =
      -((luminaire.position - p).cross(disc.d_center) + normal.cross(disc.d_normal)) / area;
  sum.d_tilt = {turn.dot(surface.axes().across), -turn.dot(surface.axes().along)};
  sum.d_size[0] = disc.d_radius / (2 * area) - 2 * sum.lx_per_lm / diameter;
  return sum;
}

// Areas of the closed form are differences of angles: rounding, 1e-16, must stay small beside them.
bool HasClosedForm(const LuminousSurface& surface, const Eigen::Vector3d& p) {
  return surface.has_extent() && OpsOf(surface.luminaire().distribution).is_diffuse &&
         surface.area_m2() > 1e-8 * (surface.luminaire().position - p).squaredNorm();
}

DirectIlluminance SumOverSurface(const LuminousSurface& surface, const Eigen::Vector3d& p,
                                 const Eigen::Vector3d& normal) {
  const Luminaire& luminaire = surface.luminaire();
  const LuminaireAxes& axes = surface.axes();
  DirectIlluminance sum;
  for (const SurfaceSample& sample : SurfaceRuleFor(surface, p, normal)) {
    const Eigen::Vector2d place(sample.a, sample.b);
    const Eigen::Vector3d to_lamp = surface.PointOf(place) - p;
    const double r2 = to_lamp.squaredNorm();
    const double height = normal.dot(to_lamp);
    if (height <= 0 || r2 < 1e-12) continue;
    const double r = std::sqrt(r2);
    const Eigen::Vector3d direction = -to_lamp / r;
    const DirectedIntensity intensity = surface.IntensityTowards(direction);
    if (intensity.cd_per_lm == 0) continue;
    // E = I(d) h / r^3 with h = n . t, d = -t / r, t = to_lamp.
    const double geometry = sample.weight * height / (r2 * r);
    const double illuminance = intensity.cd_per_lm * geometry;
    const Eigen::Vector3d& lobe = intensity.d_direction;
    const Eigen::Vector3d gradient = -geometry / r * (lobe - lobe.dot(direction) * direction) +
                                     intensity.cd_per_lm * sample.weight / (r2 * r) * normal -
                                     3 * illuminance / r2 * to_lamp;
    sum.lx_per_lm += illuminance;
    surface.AddMotion(place, gradient, sum);
    // To turn the luminaire about w turns its lobe as if the receiver had been turned by -w: dI =
    // (d_direction x d) . w. Tilts are about across and -along, the heading is about aim.
    const Eigen::Vector3d turn = geometry * lobe.cross(direction);
    sum.d_tilt += Eigen::Vector2d(turn.dot(axes.across), -turn.dot(axes.along));
    sum.d_heading += turn.dot(luminaire.aim);
    sum.d_exponent += intensity.d_exponent * geometry;
  }
  return sum;
}

double LxSummedOverSurface(const LuminousSurface& surface, const Eigen::Vector3d& p,
                           const Eigen::Vector3d& normal) {
  double lx = 0;
  for (const SurfaceSample& sample : SurfaceRuleFor(surface, p, normal)) {
    const Eigen::Vector3d to_lamp = surface.PointOf({sample.a, sample.b}) - p;
    const double r2 = to_lamp.squaredNorm(), height = normal.dot(to_lamp);
    if (height <= 0 || r2 < 1e-12) continue;
    const double r = std::sqrt(r2);
    lx += surface.IntensityTowards(-to_lamp / r).cd_per_lm * sample.weight * height / (r2 * r);
  }
  return lx;
}

// Returns the lobe of a surface with an extent, where it depends on the angle to the aim alone; nullptr else.
IntensityAboutAim LobeOf(const LuminousSurface& surface) {
  return surface.has_extent() ? AboutAimOf(surface.luminaire()) : nullptr;
}

}  // namespace

double DirectLxPerLumen(const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                        const Eigen::Vector3d& normal) {
  if (HasUnevenEmission(luminaire)) return DirectIlluminancePerLumen(luminaire, p_in_world, normal).lx_per_lm;
  const LuminousSurface surface(luminaire);
  if (!HasClosedForm(surface, p_in_world)) {
    const IntensityAboutAim lobe = LobeOf(surface);
    if (lobe == nullptr) return LxSummedOverSurface(surface, p_in_world, normal);
    const auto& rule = SurfaceRuleFor(surface, p_in_world, normal);
    return LobeSumLx(surface, p_in_world, normal, rule, LobeAboutAim(luminaire, lobe));
  }
  if (const auto* rule = FarRuleFor(surface, p_in_world, normal))
    return LobeSumLx(surface, p_in_world, normal, *rule, DiffuseLobe());
  if (surface.is_disc()) return LambertianDisc(surface, p_in_world, normal).lx_per_lm;
  return PointToPolygon(p_in_world, normal, PolygonOf(surface)) / surface.area_m2();
}

DirectIlluminance DirectIlluminancePerLumen(const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                                            const Eigen::Vector3d& normal) {
  if (HasUnevenEmission(luminaire)) {
    return SumOverCells(luminaire, [&](const Luminaire& cell) {
      return DirectIlluminancePerLumen(cell, p_in_world, normal);
    });
  }
  const LuminousSurface surface(luminaire);
  if (!HasClosedForm(surface, p_in_world)) {
    const IntensityAboutAim lobe = LobeOf(surface);
    if (lobe == nullptr) return SumOverSurface(surface, p_in_world, normal);
    const auto& rule = SurfaceRuleFor(surface, p_in_world, normal);
    return LobeSum(surface, p_in_world, normal, rule, LobeAboutAim(luminaire, lobe));
  }
  if (const auto* rule = FarRuleFor(surface, p_in_world, normal))
    return LobeSum(surface, p_in_world, normal, *rule, DiffuseLobe());
  return surface.is_disc() ? LambertianDisc(surface, p_in_world, normal)
                           : LambertianRectangle(surface, p_in_world, normal);
}

void DirectIlluminance::AddScaled(double factor, const DirectIlluminance& other) {
  lx_per_lm += factor * other.lx_per_lm;
  d_position += factor * other.d_position;
  d_tilt += factor * other.d_tilt;
  d_heading += factor * other.d_heading;
  d_size += factor * other.d_size;
  d_exponent += factor * other.d_exponent;
}

double VisibleFraction(const RayScene& rays, const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                       const Eigen::Vector3d& normal, int order) {
  const LuminousSurface surface(luminaire);
  const Eigen::Vector3d start = LiftedOff(p_in_world, normal);
  double seen = 0, in_front = 0, heights = 0;
  for (const SurfaceSample& sample : SurfaceRule(luminaire.shape, std::max(order, 1), std::max(order, 1))) {
    const Eigen::Vector3d point = surface.PointOf({sample.a, sample.b});
    const double height = normal.dot(point - p_in_world);
    heights += height;
    if (!(height > 0)) continue;
    in_front += sample.weight;
    if (!rays.Occluded(start, point)) seen += sample.weight;
  }
  if (std::isnan(heights)) return heights;
  return in_front > 0 ? seen / in_front : 0;
}

}  // namespace luxfit
