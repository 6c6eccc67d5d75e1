// Returns the direct illuminance of a luminaire, with derivatives.
//
//   E = Phi sum_q w_q I(gamma_q) max(0, n . d_q) / r_q^2
//   d_q: unit vector from the receiver to surface point q
//
// E is in lx for flux in lm; lengths in metres, world frame. It is unoccluded: multiply by VisibleFraction
// where things stand between.
//
// Lambertian rectangles and discs have closed forms for values and derivatives, cut by the receiver's plane
// or not (forward/factors/internal/polygon_factor.h, forward/factors/internal/disc_factor.h). From
// 1.7 sides away, a few points of a rectangle give the same in less time: to 3e-5 of what a receiver that faces
// it gets, and 3e-4 in derivatives (FarRuleFor). If the area is below 1e-8 of the squared distance both are
// summed as other lobes are, as rounding would show. Other lobes are sums over surface points.
//
// From the distance of the luminaire's longer side on, these sums are within 0.1 % for lobes up to cos^100.
// The error is relative to the illuminance, or to 1/1000 of that in the beam. Where the receiver's plane cuts
// the luminaire, they are within 0.2 % of the illuminance of a receiver that faces it. Tables of intensities
// have kinks at their angles: 0.2 %. Nearer, or with sharper lobes, the number of points is at its bound of
// 24 a side and the error grows.
//
// A point and a sphere are one point, the sphere's centre. This is exact for a uniform sphere that the
// receiver's plane does not cut. A sphere of radius R whose centre lies in that plane counts as 0, though it
// sends 0.21 R / r of what a receiver that faces it gets.
//
// Derivatives are those of the closed form or of the sum. They leave out the motion of shadow edges
// (forward/direct/internal/shadowed_light.h includes it). NaN in is NaN out, here and in all functions of one
// luminaire and one place; functions that take lists of them check them. Source: inverse-square cosine law,
// IES Lighting Handbook, 10th ed., ch. 10.
#ifndef LUXFIT_FORWARD_DIRECT_DIRECT_LIGHT_H_
#define LUXFIT_FORWARD_DIRECT_DIRECT_LIGHT_H_

#include <Eigen/Core>

#include "forward/luminaire/luminaire.h"
#include "forward/room/visibility.h"

namespace luxfit {

struct DirectIlluminance {
  double lx_per_lm = 0;
  Eigen::Vector3d d_position = Eigen::Vector3d::Zero();  // 1/m
  Eigen::Vector2d d_tilt = Eigen::Vector2d::Zero();      // 1/rad: aim turned towards AxesOf's along, across
  double d_heading = 0;                                  // 1/rad: turned about aim, along towards across
  Eigen::Vector2d d_size = Eigen::Vector2d::Zero();      // 1/m
  double d_exponent = 0;

  void AddScaled(double factor, const DirectIlluminance& other);
};

DirectIlluminance DirectIlluminancePerLumen(const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                                            const Eigen::Vector3d& normal);

// Returns the same without derivatives, in about half of the time.
double DirectLxPerLumen(const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                        const Eigen::Vector3d& normal);

// Returns the share of the luminaire's surface points (`order` a side) in front of the receiver's plane that
// the receiver sees; 0 where no point is in front. DirectIlluminancePerLumen leaves out the points behind the
// plane too. Every point weighs the same: forward/direct/internal/shadowed_light.h weighs points by their
// light.
double VisibleFraction(const RayScene& rays, const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                       const Eigen::Vector3d& normal, int order);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_DIRECT_LIGHT_H_
