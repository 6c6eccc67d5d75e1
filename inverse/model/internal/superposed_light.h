// Computes what photos of a state do not show of an element from other states that show it: light adds.
//
//   Y_es = sum_o w_o Y_eo   where   d_s = sum_o w_o d_o            d: dimming of the luminaires in a state
//
// A wall that a spot washes is overexposed where the spot is on alone, but not where all luminaires are on. Y_eo: mean
// relative luminance over the views. Only combinations that are exact are taken, and only sums that are a fifth of
// their terms' magnitudes or more: the rest is noise.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SUPERPOSED_LIGHT_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SUPERPOSED_LIGHT_H_

#include <vector>

#include "inverse/model/light_state.h"

namespace luxfit {

struct SuperposedLight {
  int element = 0;
  int state = 0;
  double relative_luminance = 0;
};

// Returns the elements that photos show in some states, in each state in which they do not.
std::vector<SuperposedLight> SuperposeStates(const LightData& data);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SUPERPOSED_LIGHT_H_
