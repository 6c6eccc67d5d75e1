// Which shells face the wrong way, told by the sign of the volume they enclose.
//
//   V = 1/6 sum over triangles a . (b x c)        < 0 for a room (facing inwards), > 0 for a solid
//
// Rooms hold solids, solids may hold rooms: what lies within an even number of other shells must be a room.
// That number is odd where the solid angles of all other facets, over 4 pi, round to an odd number; holes
// that are small do not change it. Source: Jacobson, Kavan, Sorkine-Hornung (2013), "Robust inside-outside
// segmentation using generalized winding numbers".
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_SHELL_VOLUME_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_SHELL_VOLUME_H_

#include <vector>

#include "forward/room/internal/mesh_topology.h"
#include "forward/room/scene.h"

namespace luxfit {

// Facets of shells that are inside out, sorted. Facets of open shells are judged together, as the room that
// T-junctions cut to pieces, and only if they close nearly. Sheets, which have no volume, are not judged.
std::vector<int> FacetsOfShellsInsideOut(const Scene& scene, const Shells& shells);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_SHELL_VOLUME_H_
