// Finds the walls and ceilings of a room, as planes whose light a grid of points tells.
//
// A side is what bounds the room: facets of one plane with nothing behind them, so that sides of furniture are none.
// Doors, windows and boards in the plane of a wall belong to it. A wall is within 17 degrees of vertical, a ceiling
// faces down within 45. Sides of less than 0.5 m2 are left out. The plane is the least rectangle over the facets,
// upright for a wall and along +x for a ceiling; its meters face into the room, 1 cm off the surface.
//
// A mesh that models a wall on both sides has something behind it: it has no sides here.
//
// The grid's spacing is p = 0.2 * 5^(log10 d) of the longer side d. Along a long wall the standard's own is finer, for
// a plane whose shorter side is less than half of the longer; light on walls asks for a mean and a U0 of 0.1 only.
//
// Units are m; world frame, z up. Source: EN 12464-1:2021, sec. 4.2.3 (illuminance of walls and ceiling).
#ifndef LUXFIT_FORWARD_VIEWS_ROOM_SIDES_H_
#define LUXFIT_FORWARD_VIEWS_ROOM_SIDES_H_

#include <vector>

#include "forward/views/illuminance_plane.h"

namespace luxfit {

struct RoomSide {
  static constexpr double kOffSurfaceM = 0.01;  // of the meters
  bool is_ceiling = false;
  IlluminancePlane plane;
  std::vector<int> facets;
  double area_m2 = 0;
};

// Returns the walls in the order of their first facet, then the ceilings.
std::vector<RoomSide> SidesOf(const Room& room);

// Classifies points over a side: those over none of its facets are outside, those within furniture or less than 5 cm
// behind it in a solid.
std::vector<GridPointKind> ClassifySidePoints(const Room& room, const RoomSide& side, const PlaneGrid& grid);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_VIEWS_ROOM_SIDES_H_
