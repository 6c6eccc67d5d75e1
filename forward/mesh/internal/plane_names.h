// Gives the planes of one material a material each, named by what they are in a room.
//
// Planes of 0.3 m2 and more are "floor", "ceiling", "wall 1", ..., or "surface 1", ..., by area; all smaller planes of each piece that hangs
// together are one ("details 1", ...), and those of pieces that are small themselves, too.
#ifndef LUXFIT_FORWARD_MESH_INTERNAL_PLANE_NAMES_H_
#define LUXFIT_FORWARD_MESH_INTERNAL_PLANE_NAMES_H_

#include <string>
#include <vector>

#include "forward/mesh/internal/grow_planes.h"
#include "forward/mesh/internal/scan_mesh.h"

namespace luxfit {

// Returns the material of each region. `materials` get the names in place of `named`; a name that is not among them leaves
// all as it is. Regions come largest first, and so do the numbers.
std::vector<int> NamePlanes(const ScanMesh& mesh, const PlanarRegions& regions, const std::string& named,
                            std::vector<std::string>& materials);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_INTERNAL_PLANE_NAMES_H_
