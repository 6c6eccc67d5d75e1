// Reads observations as if their photos' counts had gone through the curve of sRGB.
//
//   Y' = Y (w . f(t Y_c)) / (w . t Y_c),   var Y' = var Y (dY' / dY)^2
//
// f: decoding of sRGB (calib/luminance/response.h), t Y_c: share of full scale that channel c counted, w: the default weights of
// luminance. An element's mean is decoded as one pixel would be. Up to a factor that a photo's elements share.
#ifndef LUXFIT_INVERSE_OBSERVE_AS_IF_INTERNAL_SRGB_OBSERVATIONS_H_
#define LUXFIT_INVERSE_OBSERVE_AS_IF_INTERNAL_SRGB_OBSERVATIONS_H_

#include <vector>

#include "inverse/observe/as_if/photos_as_if.h"
#include "inverse/observe/observe.h"

namespace luxfit {

// Observations of other photos than those of `shares` stay as they are.
std::vector<Observation> DecodedSrgb(std::vector<Observation> observations, const CountedShares& shares);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_AS_IF_INTERNAL_SRGB_OBSERVATIONS_H_
