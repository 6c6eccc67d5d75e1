// Balances the channels of photos, and tells the colours of luminaires' light.
//
//   rgb'_c = rgb_c / w_c,     v'_c = v_c w_c                w: balance; v: weights of luminance, sum_c v_c w_c = 1
//   L_kc = w_c l_c t_kc       l: light of neutral surfaces (inverse/choose/internal/detail/colour_detail.h), t: tint of luminaire k
//
// A sensor counts more green than red and blue in any light. Materials' colours, with which light is exchanged, are those in
// balanced channels; luminance stays what it was. w_c is the middle half's mean of rgb_c / Y over surfaces that are stated to be neutral, else
// over all surfaces (grey world), else 1 where channels are balanced already. Light that reaches a neutral surface from coloured
// ones makes w err; the fit knows that light, and l_c is what luminaires send.
//
// Without a neutral surface the colours of light and of surfaces cannot be told apart: only tints can.
// Source: G. Buchsbaum (1980), "A spatial processor model for object colour perception" (grey world).
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_LIGHT_COLOURS_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_LIGHT_COLOURS_H_

#include <Eigen/Core>

#include "inverse/choose/internal/detail/colour_detail.h"
#include "inverse/fit/fit_room.h"
#include "inverse/fit/room_observations.h"

namespace luxfit {

// Returns w. Ones where no observation tells it.
Eigen::Vector3d ChannelBalance(const Room& room, const RoomObservations& given);

// Returns the data in balanced channels.
LightData WithBalance(LightData data, const Eigen::Vector3d& balance);

// Compares colours, and adds to `result` what they say: reflectances by channel, tints, and the colours of light where a neutral surface
// tells them; reflectances are then those in channels in which that light is white. `fit`: to result.data.
ColourDetail AddColours(const Room& room, const RoomObservations& given, const Eigen::Vector3d& balance,
                        const LuminaireFit& fit, RoomFit& result);

// Warns ("luminance_weights_assumed") where luminaires differ in colour so much that other usual weights of red, green and blue
// would change ratios of their fluxes by more than 1 %, and nothing states the camera's.
void WarnOfAssumedWeights(const RoomObservations& given, const RoomFit& fit, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_LIGHT_COLOURS_H_
