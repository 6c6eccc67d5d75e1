// Whether a luminaire hangs where the room can be lit from: not inside a solid, not beyond a wall.
//
// Rays in all directions from points of its surface: in a room they meet the fronts of facets (and, through
// openings, nothing). From outside the room or from beyond the plane of a ceiling every one meets a back or
// leaves; from inside a solid that was modelled without its bottom, at least the upper half meets backs. So a
// point counts as outside where no ray meets a front, or more than 40 % meet a back.
//
// Source: ray parity as in O'Rourke (1998), "Computational Geometry in C", sec. 7.3, by facing instead of
// count.
#ifndef LUXFIT_FORWARD_DIRECT_PLACEMENT_H_
#define LUXFIT_FORWARD_DIRECT_PLACEMENT_H_

#include "forward/luminaire/luminaire.h"
#include "forward/room/visibility.h"

namespace luxfit {

// Share of the luminaire's surface (0 to 1) that is outside in this sense: 1 in an empty scene.
double ShareOutsideRoom(const RayScene& rays, const Luminaire& luminaire);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_PLACEMENT_H_
