#include "forward/direct_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "forward/polygon_factor.h"

namespace luxfit {
namespace {

constexpr int kMaxOrder = 12;

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

int OrderFor(const Luminaire& luminaire, const Eigen::Vector3d& p) {
  const double size = luminaire.size_m.maxCoeff();
  const double distance = (p - luminaire.position).norm();
  return std::clamp(2 + static_cast<int>(std::ceil(3 * size / std::max(distance, 1e-3))), 2, kMaxOrder);
}

Eigen::Vector2d SidesOf(const Luminaire& luminaire) {
  if (luminaire.shape == LuminaireShape::kDisc) return Eigen::Vector2d::Constant(luminaire.size_m[0]);
  return luminaire.size_m;
}

bool IsLambertianRectangle(const Luminaire& luminaire) {
  return luminaire.shape == LuminaireShape::kRectangle && luminaire.distribution == Distribution::kLambertian;
}

// E = pi L F, L = Phi / (pi A), with F in closed form; nothing where the receiver's plane cuts the rectangle.
std::optional<DirectIlluminance> LambertianRectangle(const Luminaire& luminaire, const Eigen::Vector3d& p,
                                                     const Eigen::Vector3d& normal) {
  const LuminaireAxes axes = AxesOf(luminaire);
  const Eigen::Vector3d u = luminaire.size_m[0] * axes.along, v = luminaire.size_m[1] * axes.across;
  const ConvexPolygon polygon =
      MakePolygon(luminaire.position - 0.5 * (u + v), u, v, FacetKind::kParallelogram);
  int in_front = 0;
  for (int k = 0; k < polygon.count; ++k) in_front += normal.dot(polygon[k] - p) > 0 ? 1 : 0;
  if (in_front == 0) return DirectIlluminance{};
  if (in_front < polygon.count) return std::nullopt;
  const PolygonGradient factor = PointToPolygonGradient(p, normal, polygon);
  const double area = luminaire.size_m.prod();
  DirectIlluminance sum;
  sum.lx_per_lm = factor.factor / area;
  const Eigen::Vector2d places[4] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  for (size_t k = 0; k < 4; ++k) {
    const Eigen::Vector3d gradient = factor.d_vertex[k] / area;
    const Eigen::Vector3d offset = places[k][0] * u + places[k][1] * v;
    sum.d_position += gradient;
    sum.d_size +=
        Eigen::Vector2d(places[k][0] * gradient.dot(axes.along), places[k][1] * gradient.dot(axes.across));
    // Turns as in the sum over surface points below; a Lambertian lobe adds nothing of its own, it is the
    // surface's cosine.
    sum.d_tilt +=
        Eigen::Vector2d(gradient.dot(axes.across.cross(offset)), -gradient.dot(axes.along.cross(offset)));
    sum.d_heading += gradient.dot(luminaire.aim.cross(offset));
  }
  sum.d_size -= sum.lx_per_lm * luminaire.size_m.cwiseInverse();
  return sum;
}

}  // namespace

DirectIlluminance DirectIlluminancePerLumen(const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                                            const Eigen::Vector3d& normal) {
  if (IsLambertianRectangle(luminaire)) {
    if (const auto exact = LambertianRectangle(luminaire, p_in_world, normal)) return *exact;
  }
  DirectIlluminance sum;
  const LuminaireAxes axes = AxesOf(luminaire);
  const Eigen::Vector2d sides = SidesOf(luminaire);
  for (const SurfaceSample& sample : SurfaceRule(luminaire.shape, OrderFor(luminaire, p_in_world))) {
    const Eigen::Vector3d to_lamp = luminaire.position + sample.a * sides[0] * axes.along +
                                    sample.b * sides[1] * axes.across - p_in_world;
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
    sum.d_position += gradient;
    // Turning the lamp about w turns its surface by w x (p - position), and its lobe as if the receiver had
    // been turned by -w: dI = (d_direction x d) . w. Tilts are about across and -along, the heading is about
    // aim.
    const Eigen::Vector2d place(sample.a * sides[0], sample.b * sides[1]);
    const Eigen::Vector3d turn = geometry * lobe.cross(direction);
    const double aim_gradient = gradient.dot(luminaire.aim);
    sum.d_tilt += Eigen::Vector2d(turn.dot(axes.across), -turn.dot(axes.along)) - aim_gradient * place;
    sum.d_heading +=
        turn.dot(luminaire.aim) + place[0] * gradient.dot(axes.across) - place[1] * gradient.dot(axes.along);
    if (luminaire.shape == LuminaireShape::kDisc) {
      sum.d_size[0] += gradient.dot(sample.a * axes.along + sample.b * axes.across);
    } else {
      sum.d_size +=
          Eigen::Vector2d(sample.a * gradient.dot(axes.along), sample.b * gradient.dot(axes.across));
    }
    sum.d_exponent += intensity.d_exponent * geometry;
  }
  return sum;
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
  const LuminaireAxes axes = AxesOf(luminaire);
  const Eigen::Vector2d sides = SidesOf(luminaire);
  const Eigen::Vector3d start = LiftedOff(p_in_world, normal);
  double seen = 0, in_front = 0;
  for (const SurfaceSample& sample : SurfaceRule(luminaire.shape, std::clamp(order, 1, kMaxOrder))) {
    const Eigen::Vector3d point =
        luminaire.position + sample.a * sides[0] * axes.along + sample.b * sides[1] * axes.across;
    if (normal.dot(point - p_in_world) <= 0) continue;
    in_front += sample.weight;
    if (!rays.Occluded(start, point)) seen += sample.weight;
  }
  return in_front > 0 ? seen / in_front : 0;
}

}  // namespace luxfit
