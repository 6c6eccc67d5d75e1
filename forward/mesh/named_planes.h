// Gives the planes of a mesh whose material says nothing materials of their own.
//
// One material for the whole room, or none, tells no paint from another: floor, ceiling and walls are seldom alike. Each
// plane of 0.3 m2 and more then gets one ("floor", "ceiling", "wall 1", ..., "surface 1", ... by area), and all smaller
// planes of each piece that hangs together have one ("details 1", ...). Drawn meshes keep their facets (WithPlanesNamed);
// those of scans are laid onto planes (PlanesOptions::named_material). Boxes that photos show ("found 1", ...;
// inverse/furniture/furniture.h) keep their names.
//
// Source of the planes: forward/mesh/planes.h.
#ifndef LUXFIT_FORWARD_MESH_NAMED_PLANES_H_
#define LUXFIT_FORWARD_MESH_NAMED_PLANES_H_

#include <string>

#include "forward/room/scene.h"

namespace luxfit {

// Returns the one material that the mesh gives its surfaces, boxes that photos show aside; empty where there are several.
std::string SoleMaterialOf(const Scene& scene);

// Returns the mesh with facets of this material named by their planes.
Scene WithPlanesNamed(Scene mesh, const std::string& material);

// Tells whether each material is called, and numbered from 1 in their order, as planes are that were named so.
bool AreNamedPlanes(const Scene& scene);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_NAMED_PLANES_H_
