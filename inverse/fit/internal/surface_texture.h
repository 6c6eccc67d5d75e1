// Takes the texture of surfaces out of the data by which luminaires' models are chosen.
//
//   Y'_es = Y_es / (1 + t_e)
//
// A luminaire's model is judged in the states where it is on alone. There, an element's own reflectance and
// its light are one; all states together tell them apart (inverse/model/internal/weights/element_texture.h). t_e
// comes from a fit to all states with the simple models of the start. Only materials count whose t_e vary by
// kTextured and more: less may as well be an error of these models.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_SURFACE_TEXTURE_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_SURFACE_TEXTURE_H_

#include <vector>

#include "inverse/fit/fit_room.h"
#include "inverse/model/fit_luminaires.h"

namespace luxfit {

constexpr double kTextured = 0.03;

// Returns whether a material is textured. The fit of rooms of plain paint has no texture: nothing is spent
// there, and errors of the model stay visible.
bool IsTextured(const LuminaireFit& fit);

// `data` carries its indirect light; `fit`: one to a part of it.
LightData WithoutTexture(const Room& room, LightData data, const LuminaireFit& fit,
                         const std::vector<ParameterPrior>& priors);

// Records in `choices` by how much the elements of each material vary.
void RecordTexture(const Room& room, const LuminaireFit& fit, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_SURFACE_TEXTURE_H_
