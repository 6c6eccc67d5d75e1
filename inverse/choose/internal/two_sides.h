// Chooses for each luminaire, before its model is chosen, whether it lights up and down.
//
//   I = 1 / (4 pi)                                                                    a globe
//   I = (1 - u) cos(gamma) / pi below the horizontal, -u cos(gamma) / pi above        u: share of the flux up
//
// A pendant that lights both sides looks to a lobe like a luminaire elsewhere: its place, the reflectances and every
// other luminaire would be wrong where models are compared, and so would the indirect light that they are compared
// with. So points that light both sides are compared with the luminaire as it is on the light that photos measured,
// which no model of a luminaire enters. Beside place and flux a globe has no parameter, the others have one. Where the
// luminaire as it is leaves no more than 1 %, nothing is tried. Nor is it where no data show light from its back: light
// that nothing sees could be as much as one likes.
//
// Source: house; rule: inverse/select/one_standard_error.h.
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_TWO_SIDES_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_TWO_SIDES_H_

#include <optional>
#include <vector>

#include "inverse/choose/internal/left_out.h"
#include "inverse/model/fit_luminaires.h"

namespace luxfit {

// Returns whether data show light from both sides of a luminaire: they lie more than 6 degrees from its plane on
// either, and no surface is nearer than 0.1 m behind it. Half of what a Lambertian back emits falls within the
// distance of such a surface, on an element or two that the luminaire itself hides from the cameras.
bool SeesBothSides(const Room& room, const SubProblem& problem, const Luminaire& luminaire);

// Returns the luminaire with both sides lit, its aim downwards.
Luminaire LitOnBothSides(Luminaire luminaire, double share_up = 0.5);

// Returns the state with those luminaires that light both sides at their best; nothing where there is none.
// `data`: with measured indirect light. `is_open`: by luminaire, whether nothing is known of its distribution.
std::optional<LightState> WithTwoSides(const Room& room, const LightData& data, const LightState& state,
                                       const std::vector<bool>& is_open,
                                       const std::vector<ParameterPrior>& priors);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_TWO_SIDES_H_
