// Warns of reflectances that only indirect light tells: no photo shows the surface, and readings receive the light
// that it reflects among that of all other surfaces.
//
// Such a reflectance stands for all that the model lacks of indirect light (gloss, texture, geometry). Its sigma
// holds that (inverse/model/internal/weights/indirect_error.h), and the warning names it. Reflectances that are not
// determined have other warnings.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_INDIRECT_ALBEDO_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_INDIRECT_ALBEDO_H_

#include "inverse/fit/fit_room.h"

namespace luxfit {

// Warns ("albedo_by_indirect_light") once for each such material.
void WarnOfIndirectAlbedo(const Room& room, const RoomFit& result, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_INDIRECT_ALBEDO_H_
