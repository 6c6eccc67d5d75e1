// Finds the shells that face the wrong way, by the sign of the volume they enclose.
//
//   V = 1/6 sum over triangles a . (b x c)        < 0 for a room (facing inwards), > 0 for a solid
//
// Rooms hold solids, and solids may hold rooms: a shell within an even number of other shells must be a room.
// The number is odd where the solid angles of all other facets, over 4 pi, round to an odd number; small
// holes do not change it.
//
// Source: Jacobson, Kavan, Sorkine-Hornung (2013), "Robust inside-outside segmentation using generalized
// winding numbers".
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_SHELL_VOLUME_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_SHELL_VOLUME_H_

#include <vector>

#include "forward/room/internal/mesh_topology.h"
#include "forward/room/scene.h"

namespace luxfit {

// Returns the facets of shells that are inside out, sorted. Facets of open shells are judged together, as the
// room that T-junctions cut to pieces, and only if they nearly close. Sheets, which have no volume, are not
// judged.
std::vector<int> FacetsOfShellsInsideOut(const Scene& scene, const Shells& shells);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_SHELL_VOLUME_H_
