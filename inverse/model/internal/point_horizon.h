// Tells where the size of a luminaire matters that the model takes as one point: at its horizon.
//
//   cos theta = n . d / r,   |cos theta| < 0.21 R / r
//
// A receiver whose plane holds the centre of a disc or sphere of radius R gets 0.21 R / r of the light that one facing it
// gets: 2 / (3 pi), half of the mean |x| over a unit disc. From a point it gets none, and once the point is in front, all.
// So such a receiver would tell the point's distance from its plane to millimetres, and wrongly.
//
// The size of a point is not known. Far enough to count as a point means five times the size (CIE 121), R / r = 0.1 at
// most: |cos theta| < 0.021. A sphere has its R, and counts as long as the plane cuts it.
//
// Discs and rectangles are cut by the receiver's plane as they are (forward/direct/direct_light.h).
// Source: CIE 121 (1996), "The photometry and goniophotometry of luminaires" (limiting photometric distance).
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_POINT_HORIZON_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_POINT_HORIZON_H_

#include "forward/direct/sensor.h"
#include "forward/luminaire/luminaire.h"

namespace luxfit {

// Returns whether the receiver is at the horizon of a luminaire of one point that shines towards it: with more than
// `least_share` of its mean intensity.
bool IsAtHorizonOf(const Luminaire& luminaire, const Sensor& receiver, double least_share);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_POINT_HORIZON_H_
