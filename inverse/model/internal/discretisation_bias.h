// Computes what the size of the model's elements and patches leaves out, as a bias of every observation.
//
//   b_es = c rho / pi sum_k d_sk Phi_k ( V_ek 4/3 (mean of D_k at the quarter points - D_k at the centre)
//                                        + (G_ek - I_ek) )
//
// D: direct light at the centres of elements, where photos show the elements' means. To second order the mean
// over a parallelogram is E + (|u|^2 E_uu + |v|^2 E_vv) / 24; the mean of its quarter points has 1/32
// instead. I: indirect light as elements gather it, from patches that are evenly bright. G: indirect light
// gathered from the elements, whose direct light is finer, as sensors gather it. G - I is what the last
// reflection loses by the patches' size. The bias does not contain what earlier reflections lose.
//
// Returns one value for each observation, in its unit. Both parts are found at evenly taken elements, which
// stand for the others (0 there): up to max_elements for D, an eighth of them for G. G - I is 0 where
// indirect light was measured, and in sparse rooms.
//
// FitLuminaires subtracts what the bias moves its parameters by. A third of it stays in the covariance, for it is
// extrapolated from two sizes.
//
// Source: midpoint rule's error term, e.g. Davis and Rabinowitz (1984), "Methods of numerical integration",
// ch. 5; Reichert (1992) (final gather).
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_DISCRETISATION_BIAS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_DISCRETISATION_BIAS_H_

#include <Eigen/Core>

#include "inverse/model/light_state.h"

namespace luxfit {

Eigen::VectorXd DiscretisationBias(const Room& room, const LightData& data, const LightState& state,
                                   int max_elements = 2400);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_DISCRETISATION_BIAS_H_
