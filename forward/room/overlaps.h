// Facets drawn on one another: in one plane, facing the same way.
//
// A floor drawn twice, or a rug at the floor's own height, would emit twice though light can only meet one of
// them. What lies below is cut away, so that every point of a plane belongs to one facet. On top lies what
// has the lesser area of its material in that plane (a rug on a floor, a door in a wall); of equal ones, the
// first.
//
// Facets that face opposite ways are no overlap: a sheet with two sides, or a solid that stands on a larger
// face (forward/room/patches.h). Overlaps narrower than 20 um are rounding of the file and left as they are.
//
// Areas m2. Near linear in the facets. Source of the clipping: Sutherland and Hodgman (1974), "Reentrant
// polygon clipping".
#ifndef LUXFIT_FORWARD_ROOM_OVERLAPS_H_
#define LUXFIT_FORWARD_ROOM_OVERLAPS_H_

#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

struct FacetOverlap {
  int on_top = 0, below = 0;  // facets
  double area_m2 = 0;
};

// Ordered by the facet below.
std::vector<FacetOverlap> FindOverlaps(const Scene& scene);

// The scene with what lies below another facet cut away; unchanged, facet for facet, where nothing overlaps.
Scene WithoutOverlaps(const Scene& scene);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_OVERLAPS_H_
