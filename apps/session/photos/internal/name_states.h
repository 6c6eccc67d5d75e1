// Names matched states by what seems to be on. Light adds up, so a picture of two luminaires is the sum of two pictures.
//
//   x_s(p) = light of pixel p in state s / exposure,   over the views that show all states of the sum
//   x_s = sum_i d_i x_i,   d >= 0     s is a mix of states i where this holds to 15 % (rms), and no d > 1.1
//
// A state that is no mix is taken for one luminaire: A, B, ... in the order in which they were photographed. The mix of
// all of them at full light is `all`; other mixes are mix1, mix2, ... with their dimming. A state of less than 1 % of
// the brightest in every view is `off`. One state alone is `all`.
//
// Where exposures are not known, no state is taken for a mix. A mix of which not every part was photographed alone is
// taken for a luminaire, too: the user has to say what was on.
// Source: non-negative least squares by coordinate descent, Franc, Hlavac, Navara (2005).
#ifndef LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_NAME_STATES_H_
#define LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_NAME_STATES_H_

#include <vector>

#include "apps/session/photos/internal/tag_light.h"
#include "apps/session/photos/photo_names.h"

namespace luxfit {

// Returns the states by their numbers.
std::vector<GuessedState> NameStates(const std::vector<PhotoLook>& photos,
                                     const std::vector<LightGroup>& groups,
                                     const std::vector<int>& state_of_group);

// Returns the states, known by their names, with what the light tells of occasions: the mix of the states of one
// luminaire each that they are. An occasion whose light is no such mix stays as it is, and says so.
std::vector<GuessedState> WithMixesOfOccasions(std::vector<GuessedState> states,
                                               const std::vector<PhotoLook>& photos,
                                               const std::vector<LightGroup>& groups,
                                               const std::vector<int>& state_of_group);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_NAME_STATES_H_
