// Form-factor rows pair by pair: closed form or quadrature of what would be seen, times the share that is
// visible.
//
// Pairs that shaft culling proves free need no ray. Unoccluded factors, by distance d against the larger
// radius R of the two:
//   d > 4 R      Gauss 2 x 2 points on the patch, 1 (small elements) or 2 x 2 on the element: relative error
//   < 2e-3, typically 3e-4 d > 2.2 R    Gauss 3 x 3 on the patch, 2 x 2 or 3 x 3 on the element: < 6e-4
//   nearer       closed form, point to polygon from Gauss points of a small element, or the double contour
// Partly hidden pairs get rays between points spread over both, one at least and as many as their share of
// the hemisphere asks for; four times as many where those disagree. Elements that are partly inside a solid
// cast rays over the hemisphere.
#ifndef LUXFIT_FORWARD_FACTORS_INTERNAL_PAIR_ROWS_H_
#define LUXFIT_FORWARD_FACTORS_INTERNAL_PAIR_ROWS_H_

#include "forward/factors/form_factors.h"

namespace luxfit {

// `method`: kHybrid, or kAnalytic (the double contour for every pair).
FormFactors PairFormFactors(const RayScene& rays, const Patches& patches, FormFactorMethod method,
                            int rays_per_element);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_INTERNAL_PAIR_ROWS_H_
