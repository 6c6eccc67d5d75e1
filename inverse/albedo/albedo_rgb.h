// Reflectance by colour channel, once luminaires and camera scale are known.
//
//   rho_c = rho * rho'_c / rho'
//   rho: of the fit; rho': fitted to the channel and to the luminance, with the indirect light as measured in
//   each (inverse/model/measured_indirect.h)
//
// So interreflection carries the colour of what reflects it, and what patches that no photo shows make
// uncertain of it cancels. Assumes that the luminaires are neutral in the camera's RGB: where they are not,
// their tint is in the reflectances of all materials alike.
//
// Reflectances in 0..1, one column a material, rows red, green, blue; NaN for materials that `fit` held
// fixed.
// Source: inverse/model/measured_indirect.h.
#ifndef LUXFIT_INVERSE_ALBEDO_ALBEDO_RGB_H_
#define LUXFIT_INVERSE_ALBEDO_ALBEDO_RGB_H_

#include <Eigen/Core>

#include "inverse/model/fit_luminaires.h"

namespace luxfit {

Eigen::Matrix3Xd EstimateAlbedoRgb(const Room& room, const LightData& data, const LuminaireFit& fit);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_ALBEDO_RGB_H_
