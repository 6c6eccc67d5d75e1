// Moves luminaires, before their models are compared, to where their outlines in photos say.
//
// Light alone leaves a luminaire centimetres off. Its outlines are then many pixels from its model, and robust weights
// take them for those of something else: the fit stays where it is, or creeps.
//
// The middles of its outlines are triangulated (calib/register/triangulation.h). The middle is the centroid of what an
// outline encloses in a plane parallel to the luminaire's: its direction does not depend on the plane's distance. The
// middle of the picture would be that of a place up to 0.1 m nearer, for a large panel seen obliquely.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_START_AT_OUTLINES_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_START_AT_OUTLINES_H_

#include <vector>

#include "forward/light/room.h"
#include "inverse/model/light_state.h"

namespace luxfit {

// Returns the state with those luminaires moved whose position is free, of whose outlines three views or more meet, and
// that are at most 0.15 m off. None passes through a surface: what hangs under a ceiling may be triangulated above it.
LightState AtOutlines(const Room& room, const std::vector<LuminaireOutline>& outlines, LightState state);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_START_AT_OUTLINES_H_
