// Direct illuminance of a luminaire, with derivatives.
//
//   E = Phi sum_q w_q I(gamma_q) max(0, n . d_q) / r_q^2
//   d_q: unit vector from the receiver to surface point q
//
// lx for flux in lm, metres, world frame. Unoccluded: multiply by VisibleFraction where things stand between.
//
// Lambertian rectangles and discs have their closed forms, values and derivatives, cut by the receiver's
// plane or not (forward/factors/internal/polygon_factor.h, forward/factors/internal/disc_factor.h); only if their area is below 1e-8 of the
// squared distance they are summed too, as rounding would show. Other lobes are sums over surface points.
// From the distance of the luminaire's longer side on these are within 0.1 %, of the illuminance or of 1/1000
// of that in the beam, for lobes up to cos^100; where the receiver's plane cuts the luminaire, within 0.2 %
// of what a receiver that faces it gets. Tables of intensities are kinked at their angles: 0.2 %. Nearer, or
// with sharper lobes, the number of points is at its bound of 24 a side and the error grows. A point and a
// sphere are one point, the sphere's centre: exact for a uniform sphere that the receiver's plane does not
// cut; one of radius R whose centre lies in that plane sends 0.21 R / r of what a receiver that faces it
// gets, but counts as 0.
//
// Derivatives are those of the closed form or of the sum; they leave out the motion of shadow edges
// (forward/direct/internal/shadowed_light.h has it). NaN in is NaN out, here and in all functions of one luminaire and one
// place: what takes lists of them has checked them. Source: inverse-square cosine law, IES Lighting Handbook,
// 10th ed., ch. 10.
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

// Share of the luminaire's surface points (`order` a side) in front of the receiver's plane that it sees; 0
// where none is. What lies behind the plane is no part of DirectIlluminancePerLumen either. Every point
// weighs the same: forward/direct/internal/shadowed_light.h weighs them by their light.
double VisibleFraction(const RayScene& rays, const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                       const Eigen::Vector3d& normal, int order);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_DIRECT_LIGHT_H_
