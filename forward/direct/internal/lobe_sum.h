// Sums the light of a flat luminous surface over its points, where the lobe depends on the angle to the aim alone.
//
//   E = Phi sum_q w_q h_q I(c / r_q) / r_q^3          h_q = n . t_q,  c = -aim . t_q,  t_q: from the receiver to point q
//   g = dE_q / dt_q = u n - a aim - v t_q,   u = w I / r^3,  a = w h I' / r^4,  v = (3 h u + a c) / r^2
//
// All points lie in one plane square to the aim, so c is the same for all, and value and derivatives are sums of
// u, a and v with their moments about the centre: scalars, where sums of vectors take twice the time.
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_LOBE_SUM_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_LOBE_SUM_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "forward/direct/direct_light.h"
#include "forward/direct/internal/luminous_surface.h"
#include "forward/luminaire/distribution_ops.h"

namespace luxfit {

// Gives the squared distances of a surface's points and their heights over the receiver's plane, by their places along
// and across, m.
struct PointsSeenFrom {
  PointsSeenFrom(const LuminousSurface& surface, const Eigen::Vector3d& p, const Eigen::Vector3d& normal)
      : to_centre(surface.luminaire().position - p),
        in_front(-surface.luminaire().aim.dot(to_centre)),
        r2_along(2 * to_centre.dot(surface.axes().along)),
        r2_across(2 * to_centre.dot(surface.axes().across)),
        height_along(normal.dot(surface.axes().along)),
        height_across(normal.dot(surface.axes().across)),
        r2(to_centre.squaredNorm()),
        height(normal.dot(to_centre)) {}

  double R2(double x, double y) const { return r2 + x * (r2_along + x) + y * (r2_across + y); }
  double Height(double x, double y) const { return height + x * height_along + y * height_across; }
  // NaN counts as seen, so that it is not lost.
  static bool IsSeen(double own_height, double own_r2) { return !(own_height <= 0) && !(own_r2 < 1e-12); }

  Eigen::Vector3d to_centre;
  double in_front;  // c
  double r2_along, r2_across, height_along, height_across;
  double r2, height;  // of the centre
};

// Holds an intensity over the distance, I / r (cd/lm/m), its slope I' by cos(gamma), and its slope by the exponent over r.
struct LobeAt {
  double over_r = 0, d_cosine = 0, d_exponent_over_r = 0;
};

// Gives the lobe of a diffuse surface, without a root. `in_front`: c; `over_r2`: 1 / r^2.
struct DiffuseLobe {
  LobeAt operator()(double in_front, double over_r2) const {
    return in_front > 0 ? LobeAt{in_front * over_r2 / M_PI, 1 / M_PI, 0} : LobeAt{};
  }
};

// Gives the lobe of AboutAimOf(luminaire) (forward/luminaire/distribution_ops.h).
class LobeAboutAim {
 public:
  LobeAboutAim(const Luminaire& luminaire, IntensityAboutAim about_aim)
      : luminaire_(&luminaire), about_aim_(about_aim) {}

  LobeAt operator()(double in_front, double over_r2) const {
    const double over_r = std::sqrt(over_r2);
    const Intensity intensity = about_aim_(*luminaire_, in_front * over_r);
    return {intensity.cd_per_lm * over_r, intensity.d_cosine, intensity.d_exponent * over_r};
  }

 private:
  const Luminaire* luminaire_;
  IntensityAboutAim about_aim_;
};

// `lobe`: returns the LobeAt a point by c and 1 / r^2.
template <typename Lobe>
double LobeSumLx(const LuminousSurface& surface, const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                 const std::vector<SurfaceSample>& rule, const Lobe& lobe) {
  const PointsSeenFrom points(surface, p, normal);
  double lx = 0;
  for (const SurfaceSample& sample : rule) {
    const double x = sample.a * surface.sides()[0], y = sample.b * surface.sides()[1];
    const double height = points.Height(x, y), r2 = points.R2(x, y);
    if (!PointsSeenFrom::IsSeen(height, r2)) continue;
    const double over_r2 = 1 / r2;
    lx += sample.weight * height * lobe(points.in_front, over_r2).over_r * over_r2;
  }
  return lx;
}

template <typename Lobe>
DirectIlluminance LobeSum(const LuminousSurface& surface, const Eigen::Vector3d& p,
                          const Eigen::Vector3d& normal, const std::vector<SurfaceSample>& rule,
                          const Lobe& lobe) {
  const PointsSeenFrom points(surface, p, normal);
  DirectIlluminance light;
  double u = 0, ux = 0, uy = 0, a = 0, ax = 0, ay = 0;
  double v = 0, vx = 0, vy = 0, vxx = 0, vxy = 0, vyy = 0;
  for (const SurfaceSample& sample : rule) {
    const double x = sample.a * surface.sides()[0], y = sample.b * surface.sides()[1];
    const double height = points.Height(x, y), r2 = points.R2(x, y);
    if (!PointsSeenFrom::IsSeen(height, r2)) continue;
    const double over_r2 = 1 / r2, weight = sample.weight * over_r2;
    const LobeAt intensity = lobe(points.in_front, over_r2);
    const double own_u = weight * intensity.over_r;
    const double own_a = weight * over_r2 * height * intensity.d_cosine;
    const double own_v = (3 * height * own_u + own_a * points.in_front) * over_r2;
    light.lx_per_lm += height * own_u;
    light.d_exponent += weight * height * intensity.d_exponent_over_r;
    u += own_u, ux += own_u * x, uy += own_u * y;
    a += own_a, ax += own_a * x, ay += own_a * y;
    v += own_v, vx += own_v * x, vy += own_v * y;
    vxx += own_v * x * x, vxy += own_v * x * y, vyy += own_v * y * y;
  }
  const Eigen::Vector3d &aim = surface.luminaire().aim, &along = surface.axes().along,
                        &across = surface.axes().across;
  // The sums of g, and of g times the points' places.
  const Eigen::Vector3d g = u * normal - a * aim - v * points.to_centre - vx * along - vy * across;
  const Eigen::Vector3d gx = ux * normal - ax * aim - vx * points.to_centre - vxx * along - vxy * across;
  const Eigen::Vector3d gy = uy * normal - ay * aim - vy * points.to_centre - vxy * along - vyy * across;
  // A turn moves the points, and the lobe with the aim: c changes by -t . d_aim.
  const Eigen::Vector3d lobe_turn = a * points.to_centre + ax * along + ay * across;
  light.d_position = g;
  light.d_tilt = {-aim.dot(gx) - lobe_turn.dot(along), -aim.dot(gy) - lobe_turn.dot(across)};
  light.d_heading = across.dot(gx) - along.dot(gy);
  const Eigen::Vector2d& sides = surface.sides();
  const Eigen::Vector2d by_size(sides[0] > 0 ? along.dot(gx) / sides[0] : 0,
                                sides[1] > 0 ? across.dot(gy) / sides[1] : 0);
  light.d_size = surface.is_disc() ? Eigen::Vector2d(by_size.sum(), 0) : by_size;
  return light;
}

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_LOBE_SUM_H_
