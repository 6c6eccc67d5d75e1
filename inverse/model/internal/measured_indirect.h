// Computes the light from other surfaces as the photos measured it: interreflection without a solve.
//
//   I_es = sum_j F_ej Y_js         relative luminance that this light gives a white element (albedo 1)
//   Y_es = rho_m(e) (I_es + c / pi * sum_k d_sk Phi_k D_ek)
//
// F: form factors, Y_js: mean relative luminance of patch j in state s, c: camera scale, D: direct
// illuminance of luminaire k per lumen.
//
// With I known, a luminaire is fitted to what it lights directly. This needs no radiosity solution and finds
// luminaires quickly. Patches that no photo shows get the mean of their facet, of their material, or of all.
// This is an error of the model, so the final fit solves the radiosity.
//
// Once a radiosity model fits, its I is as good and free of the photos' noise. It hardly changes with the
// distribution or shape of one luminaire, so models of luminaires are compared with it.
// Source: Yu, Debevec, Malik, Hawkins (1999), "Inverse global illumination", sec. 4.1.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_MEASURED_INDIRECT_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_MEASURED_INDIRECT_H_

#include <Eigen/Core>

#include "inverse/model/light_state.h"

namespace luxfit {

// Returns `data` with Observation::relative_indirect filled in and its readings removed (indirect_is_held).
LightData WithMeasuredIndirect(const Room& room, const LightData& data);
// Returns the same with the indirect light of the radiosity model `light`.
LightData WithModelledIndirect(const Room& room, const LightData& data, const LightState& light);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_MEASURED_INDIRECT_H_
