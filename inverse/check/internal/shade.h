// Tells whether a reading is what its place would have in the shade of one luminaire.
//
//   missing = P - y,   D_k >= 2/3 missing,   y - (P - D_k) <= z_limit sigma          lx
//
// y: measured. P: predicted. D_k: its part that comes straight from luminaire k. sigma: of y - P. What hides a luminaire
// hides some reflected light too: hence the third. The last holds in all states at that place: else the light arrives.
#ifndef LUXFIT_INVERSE_CHECK_INTERNAL_SHADE_H_
#define LUXFIT_INVERSE_CHECK_INTERNAL_SHADE_H_

#include <string>
#include <vector>

#include "inverse/check/luxmeter_check.h"

namespace luxfit {

// Names the luminaires that readings are in the shade of; empty: none. Of several that fit, the one that leaves least.
// Where a third or more of the places that a luminaire lights, by more than z_limit sigma, would be in its shade, it is not
// where the fit has it, and no shade is named. In the other states of a place in shade, any light that is missing is laid to it. `factor`: the common factor of the predictions.
std::vector<std::string> ShadingLuminaires(const std::vector<NamedReading>& readings, double factor,
                                           double z_limit);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHECK_INTERNAL_SHADE_H_
