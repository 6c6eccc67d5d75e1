// Lays the surface of a fine mesh, such as a scan, onto planes.
//
//   region: triangles within off_plane_m of one plane and 40 degrees of its normal, grown from the flattest ones
//   x' = argmin sum_r (n_r . x' - d_r)^2 over the planes that meet at a vertex x; least |x' - x| where they leave it free
//
// Light needs no more facets than there are planes: a scan of 36 000 triangles with bumps of 5 mm becomes some tens of
// rectangles, cut into patches as those of a drawn room are, and the errors of the scan average out over each. Vertices
// move onto the planes that meet there, so that edges between them are straight and closed. Rays meet the triangles as they
// lie then (Scene::surface); elements count with the area that these cover.
//
// Holes of up to 1.2 m, as scanners leave them, are closed. Pieces that no neighbour takes in are planes of their own,
// however small. Rooms of more planes than `most_planes` are laid onto coarser ones, up to ten times as far off; what is left
// then of small pieces (a plant, a heap of cables) is gathered: those of 0.4 m of space that face alike share a plane.
// Planes of one material get a material each where that is asked for (forward/mesh/named_planes.h).
//
// Lengths in m, world frame. Sources: Rabbani, van den Heuvel, Vosselman (2006), "Segmentation of point clouds using
// smoothness constraint" (region growing); Garland and Heckbert (1997), "Surface simplification using quadric error
// metrics" (the place of a vertex from its planes).
#ifndef LUXFIT_FORWARD_MESH_PLANES_H_
#define LUXFIT_FORWARD_MESH_PLANES_H_

#include <string>

#include "forward/room/patches.h"
#include "forward/room/scene.h"

namespace luxfit {

struct PlanesOptions {
  double off_plane_m = 0.03;    // depth cameras err by a centimetre or two; light hardly sees such relief
  double largest_hole_m = 1.2;  // diagonal of holes that are closed
  int most_planes = 1200;       // more become fewer, see above
  std::string named_material;   // its planes get names; empty: none do
};

struct LaidOnPlanes {
  int triangles = 0, closed_holes = 0;
  double rms_m = 0;  // distance of the mesh's vertices to their planes, by area
};
struct OnPlanes {
  Scene scene;  // facets are rectangles, with `surface`
  LaidOnPlanes how;
};
OnPlanes LayOnPlanes(const Scene& mesh, const PlanesOptions& options = {});

// Merges triangles that share a plane to half a millimetre, where that leaves far fewer patches to cut: long triangles are
// cut as finely across as along. Returns other meshes as they are.
Scene WithTrianglesMerged(const Scene& mesh);

// Tells whether a mesh would be cut into far more patches than its area asks for: its facets are finer than patches, or are
// long triangles, which are cut as finely across as along.
bool IsFinerThanPatches(const Scene& mesh, const PatchesOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_PLANES_H_
