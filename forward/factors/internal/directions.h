// Sets of directions over a hemisphere with the form factor that each stands for.
//
// Local frame: z along the receiver's normal. Weights add up to the share of the hemisphere that the set
// covers: 1, but for the single plane, which leaves out the horizon, and the hemicube's small quadrature
// error. Sources: see forward/factors/form_factors.h.
#ifndef LUXFIT_FORWARD_FACTORS_INTERNAL_DIRECTIONS_H_
#define LUXFIT_FORWARD_FACTORS_INTERNAL_DIRECTIONS_H_

#include <Eigen/Core>
#include <cstdint>

#include "forward/factors/form_factors.h"

namespace luxfit {

struct Directions {
  Eigen::Matrix3Xf unit;
  Eigen::VectorXf weight;
};

// About `count` directions of a ray method; `variant` seeds the random ones.
Directions MakeDirections(FormFactorMethod method, int count, uint64_t variant);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_INTERNAL_DIRECTIONS_H_
