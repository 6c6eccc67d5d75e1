#include "forward/direct_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "forward/disc_factor.h"
#include "forward/internal/cell_sum.h"
#include "forward/internal/luminous_surface.h"
#include "forward/photometry.h"
#include "forward/polygon_factor.h"

namespace luxfit {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kMaxOrder = 24;

// Quadrature rules are made once: they depend on nothing but shape and order.
const std::vector<SurfaceSample>& SurfaceRule(LuminaireShape shape, int order) {
  using Rules = std::array<std::vector<SurfaceSample>, kMaxOrder + 1>;
  static const auto make = [](LuminaireShape s) {
    Rules rules;
    for (int n = 1; n <= kMaxOrder; ++n) rules[static_cast<size_t>(n)] = SampleSurface(s, n);
    return rules;
  };
  static const Rules rectangle = make(LuminaireShape::kRectangle), disc = make(LuminaireShape::kDisc);
  static const std::vector<SurfaceSample> point = SampleSurface(LuminaireShape::kPoint, 1);
  if (shape == LuminaireShape::kRectangle) return rectangle[static_cast<size_t>(order)];
  if (shape == LuminaireShape::kDisc) return disc[static_cast<size_t>(order)];
  return point;
}

// Exponent of the cosine-power lobe that is as narrow.
double SharpnessOf(const Luminaire& luminaire) {
  switch (luminaire.distribution) {
    case Distribution::kIsotropic:
    case Distribution::kLambertian:
      break;
    case Distribution::kCosinePower:
      return std::max(luminaire.cosine_exponent, 1.0);
    case Distribution::kMeasured:
      if (luminaire.table) return std::max(2 * kPi * luminaire.table->peak_cd_per_lm - 1, 1.0);
  }
  return 1;
}

// A lobe cos^m is 1 / sqrt(m) wide. Where the receiver's plane cuts the surface, the integrand has a kink.
int OrderFor(const LuminousSurface& surface, const Eigen::Vector3d& p, bool is_cut) {
  const double distance = std::max((p - surface.luminaire().position).norm(), 1e-3);
  const double order = std::ceil(2 + 2 * std::sqrt(SharpnessOf(surface.luminaire()) + 3) *
                                         surface.sides().maxCoeff() / distance) *
                       (is_cut ? 3 : 1);
  return order < kMaxOrder ? static_cast<int>(order) : kMaxOrder;  // NaN too
}

// E = pi L F, L = Phi / (pi A), with F in closed form.
DirectIlluminance LambertianRectangle(const LuminousSurface& surface, const Eigen::Vector3d& p,
                                      const Eigen::Vector3d& normal) {
  const Eigen::Vector2d& sides = surface.sides();
  const Eigen::Vector3d u = sides[0] * surface.axes().along, v = sides[1] * surface.axes().across;
  const PolygonGradient factor = PointToPolygonGradient(
      p, normal, MakePolygon(surface.PointOf({-0.5, -0.5}), u, v, FacetKind::kParallelogram));
  const double area = surface.area_m2();
  DirectIlluminance sum;
  sum.lx_per_lm = factor.factor / area;
  const Eigen::Vector2d corners[4] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  // A Lambertian lobe adds nothing of its own to a turn: it is the surface's cosine.
  for (size_t k = 0; k < 4; ++k) surface.AddMotion(corners[k], factor.d_vertex[k] / area, sum);
  sum.d_size -= sum.lx_per_lm * sides.cwiseInverse();
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
  // Turning the lamp is turning centre and receiver's normal about the receiver the other way.
  const Eigen::Vector3d turn =
      -((luminaire.position - p).cross(disc.d_center) + normal.cross(disc.d_normal)) / area;
  sum.d_tilt = {turn.dot(surface.axes().across), -turn.dot(surface.axes().along)};
  sum.d_size[0] = disc.d_radius / (2 * area) - 2 * sum.lx_per_lm / diameter;
  return sum;
}

// In closed form areas are differences of angles: rounding, 1e-16, is to stay small beside them.
bool HasClosedForm(const LuminousSurface& surface, const Eigen::Vector3d& p) {
  return surface.has_extent() && surface.luminaire().distribution == Distribution::kLambertian &&
         surface.area_m2() > 1e-8 * (surface.luminaire().position - p).squaredNorm();
}

DirectIlluminance SumOverSurface(const LuminousSurface& surface, const Eigen::Vector3d& p,
                                 const Eigen::Vector3d& normal) {
  const Luminaire& luminaire = surface.luminaire();
  const LuminaireAxes& axes = surface.axes();
  DirectIlluminance sum;
  const double height_of_centre = normal.dot(luminaire.position - p);
  const double reach = 0.5 * (std::abs(surface.sides()[0] * normal.dot(axes.along)) +
                              std::abs(surface.sides()[1] * normal.dot(axes.across)));
  if (height_of_centre < -reach) return sum;
  const int order = surface.has_extent() ? OrderFor(surface, p, height_of_centre < reach) : 1;
  for (const SurfaceSample& sample : SurfaceRule(luminaire.shape, order)) {
    const Eigen::Vector2d place(sample.a, sample.b);
    const Eigen::Vector3d to_lamp = surface.PointOf(place) - p;
    const double r2 = to_lamp.squaredNorm();
    const double height = normal.dot(to_lamp);
    if (height <= 0 || r2 < 1e-12) continue;
    const double r = std::sqrt(r2);
    const Eigen::Vector3d direction = -to_lamp / r;
    const DirectedIntensity intensity = IntensityPerLumen(luminaire, axes, direction);
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
    // Turning the lamp about w turns its lobe as if the receiver had been turned by -w: dI = (d_direction x
    // d) . w. Tilts are about across and -along, the heading is about aim.
    const Eigen::Vector3d turn = geometry * lobe.cross(direction);
    sum.d_tilt += Eigen::Vector2d(turn.dot(axes.across), -turn.dot(axes.along));
    sum.d_heading += turn.dot(luminaire.aim);
    sum.d_exponent += intensity.d_exponent * geometry;
  }
  return sum;
}

}  // namespace

DirectIlluminance DirectIlluminancePerLumen(const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                                            const Eigen::Vector3d& normal) {
  if (HasUnevenEmission(luminaire)) {
    return SumOverCells(luminaire, [&](const Luminaire& cell) {
      return DirectIlluminancePerLumen(cell, p_in_world, normal);
    });
  }
  const LuminousSurface surface(luminaire);
  if (!HasClosedForm(surface, p_in_world)) return SumOverSurface(surface, p_in_world, normal);
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
  for (const SurfaceSample& sample : SurfaceRule(luminaire.shape, std::clamp(order, 1, kMaxOrder))) {
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
