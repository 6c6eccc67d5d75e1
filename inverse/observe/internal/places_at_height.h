// Finds places of luminaires on the height that others share, from one ray each.
//
//   p(u) = o + d(u) (z - o_z) / d_z(u)         sigma^2 = |p(u + s_u) - p(u)|^2 + |p(u + s_v) - p(u)|^2 + (|d| s_z / d_z)^2
//
// Rooms have luminaires of one kind at one height. Where three places and more that three views show have like heights and
// areas, each further blob of such an area on that height is a place, from one view on. Two rays of different luminaires
// that meet by chance off that height are told from it so.
//
// o, d: origin and direction of the ray through a pixel; u: a blob's centre, s_u and s_v: its sigma along the picture's axes;
// z, s_z: mean height of the places and its sigma. Units: m, m2; world frame, z up. Source: own.
#ifndef LUXFIT_INVERSE_OBSERVE_INTERNAL_PLACES_AT_HEIGHT_H_
#define LUXFIT_INVERSE_OBSERVE_INTERNAL_PLACES_AT_HEIGHT_H_

#include <vector>

#include "inverse/observe/internal/place_sights.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

// Adds such places to those that were triangulated, takes them for less sure ones in their stead, and leaves out places of
// two views whose blobs all belong to others.
void AddPlacesAtCommonHeights(const PlaceSights& sights, std::vector<SeenPlace>& places);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_INTERNAL_PLACES_AT_HEIGHT_H_
