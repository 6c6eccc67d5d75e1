// What the model leaves out by taking direct light at the centres of elements: photos show their means.
//
//   b_es = c rho / pi sum_k d_sk Phi_k V_ek 4/3 (mean of D_k at the quarter points - D_k at the centre)
//
// The mean over a parallelogram is E + (|u|^2 E_uu + |v|^2 E_vv) / 24 to second order, that of its quarter
// points has 1/32 instead. Indirect light varies too slowly to count. One value an observation, in its unit;
// 0 for elements that are not among the `max_elements` taken evenly, the others then counting for them.
// Source: midpoint rule's error term, e.g. Davis and Rabinowitz (1984), "Methods of numerical integration",
// ch. 5.
#ifndef LUXFIT_INVERSE_INTERNAL_ELEMENT_BIAS_H_
#define LUXFIT_INVERSE_INTERNAL_ELEMENT_BIAS_H_

#include <Eigen/Core>

#include "inverse/light_model.h"

namespace luxfit {

Eigen::VectorXd ElementBias(const Room& room, const LightData& data, const LightState& state,
                            int max_elements = 2000);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_INTERNAL_ELEMENT_BIAS_H_
