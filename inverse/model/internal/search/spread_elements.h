// Chooses the elements by which luminaires are searched for: spread evenly, and more of them where a beam falls.
//
//   s_ie = 1 - rho_m I_ie / Y_ie        share of direct light of element e in state i, m: its material
//
// Few of the elements spread over a room lie within a narrow beam. The others show its indirect light, which the photos
// measured and any luminaire explains: their number would hide that no luminaire is in its place. So each state gets
// elements that direct light fills by half and more until there are enough of them, the brightest first.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_SPREAD_ELEMENTS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_SPREAD_ELEMENTS_H_

#include <vector>

#include "forward/light/room.h"
#include "inverse/model/light_state.h"

namespace luxfit {

// `data`: with measured indirect light. Returns all observations of about `max_elements` elements, and of those that
// beams take beside.
std::vector<Observation> SpreadElements(const Room& room, const LightData& data, int max_elements);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_SPREAD_ELEMENTS_H_
