// Estimates reflectance by colour channel, once luminaires and camera scale are known.
//
//   rho_c = rho * rho'_c / rho'
//
// rho: reflectance of the fit. rho'_c, rho': reflectances fitted to the channel and to the luminance, each
// with its measured indirect light (inverse/model/internal/measured_indirect.h). Interreflection thus
// carries the colour of the reflecting surfaces, and errors by patches that no photo shows cancel.
//
// Returns reflectances in 0..1, one column for each material, rows red, green, blue; NaN for materials that
// `fit` held fixed. Assumes that the luminaires are neutral in the camera's RGB. Where they are not, their
// tint is in the reflectances of all materials alike.
// Source: inverse/model/internal/measured_indirect.h.
#ifndef LUXFIT_INVERSE_ALBEDO_INTERNAL_ALBEDO_RGB_H_
#define LUXFIT_INVERSE_ALBEDO_INTERNAL_ALBEDO_RGB_H_

#include <Eigen/Core>

#include "inverse/model/fit_luminaires.h"

namespace luxfit {

Eigen::Matrix3Xd EstimateAlbedoRgb(const Room& room, const LightData& data, const LuminaireFit& fit);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_INTERNAL_ALBEDO_RGB_H_
