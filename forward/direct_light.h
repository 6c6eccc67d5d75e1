// Direct illuminance of a luminaire, with derivatives.
//
//   E = Phi sum_q w_q I(gamma_q) max(0, n . d_q) / r_q^2,     d_q = unit vector from the receiver to surface
//   point q
//
// lx for flux in lm, metres, world frame. Unoccluded: multiply by VisibleFraction where things stand between.
// A Lambertian rectangle has its closed form (forward/polygon_factor.h), a point and a uniform sphere are one
// point; the others are sums over surface points, whose number grows as the receiver comes near, so that the
// error stays below 0.1 %. Derivatives are those of the sum; they leave out the motion of shadow edges
// (forward/shadowed_light.h has it). Source: inverse-square cosine law, IES Lighting Handbook, 10th ed.,
// ch. 10.
#ifndef LUXFIT_FORWARD_DIRECT_LIGHT_H_
#define LUXFIT_FORWARD_DIRECT_LIGHT_H_

#include <Eigen/Core>

#include "forward/luminaire.h"
#include "forward/visibility.h"

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
// weighs the same: forward/shadowed_light.h weighs them by their light.
double VisibleFraction(const RayScene& rays, const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                       const Eigen::Vector3d& normal, int order);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_LIGHT_H_
