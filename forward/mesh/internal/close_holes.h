// Closes the holes of a mesh whose triangles lie on planes.
//
// Each side of a hole's rim gets a triangle to one common vertex, in the region of the side's own triangle: the planes around
// the hole go on. The vertex belongs to all of them, so that laid onto its planes it lies where they meet: a hole across an
// edge of the room is closed by both walls, one in a corner by three. A side of a scrap takes the larger region whose plane it
// lies nearest to.
#ifndef LUXFIT_FORWARD_MESH_INTERNAL_CLOSE_HOLES_H_
#define LUXFIT_FORWARD_MESH_INTERNAL_CLOSE_HOLES_H_

#include "forward/mesh/internal/grow_planes.h"
#include "forward/mesh/internal/scan_mesh.h"

namespace luxfit {

// Returns the number of holes closed. `largest_hole_m`: diagonal of the box round a hole, up to which it is closed.
int CloseHoles(double largest_hole_m, ScanMesh& mesh, PlanarRegions& regions);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_INTERNAL_CLOSE_HOLES_H_
