// Form factors by Wallace's disc approximation, cast from the receiver.
//
//   F_ej = sum_k V_k cos cos' A_k / (pi r_k^2 + A_k)
//
// from the element's centre to pieces of patch j, each taken for a disc of its area A_k, a shadow ray to its
// centre. The rays of an element are shared out evenly over the patches, one a patch at least.
//
// Source: Wallace, Elmquist, Haines (1989), "A ray tracing algorithm for progressive radiosity", eq. 9.
#ifndef LUXFIT_FORWARD_FACTORS_INTERNAL_DISC_ROWS_H_
#define LUXFIT_FORWARD_FACTORS_INTERNAL_DISC_ROWS_H_

#include "forward/factors/form_factors.h"

namespace luxfit {

FormFactors DiscFormFactors(const RayScene& rays, const Patches& patches, int rays_per_element);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_INTERNAL_DISC_ROWS_H_
