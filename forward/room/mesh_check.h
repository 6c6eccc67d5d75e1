// What is wrong with a mesh, what that does to the light, and how to mend it.
//
// Open edges (m of edge that no other facet closes), facets wound against their neighbours, shells that are
// inside out (rooms must face inwards, solids in them outwards), duplicates and coplanar overlaps (m2), and
// what looks odd but changes nothing: slivers, edges of three or more facets, T-junctions. Solids may stand
// on larger faces (forward/room/patches.h): an edge that runs over another facet is closed by it.
//
// Form factors by rays need no shared vertices, so T-junctions and slivers never affect the light. Vertices
// within 20 um are one. Near linear: 1e5 facets take less than a second. Source: Baum, Mann, Smith, Winget
// (1991), "Making radiosity usable: automatic preprocessing and meshing techniques for the generation of
// accurate radiosity solutions"; solid angle of a triangle: Van Oosterom and Strackee (1983).
#ifndef LUXFIT_FORWARD_ROOM_MESH_CHECK_H_
#define LUXFIT_FORWARD_ROOM_MESH_CHECK_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

enum class MeshDefect {
  kOpenMesh,
  kFlippedFacets,
  kInsideOut,
  kDuplicateFacets,
  kCoplanarOverlap,
  kFacetsDropped,
  kSliverFacets,
  kNonManifoldEdges,
  kTJunctions,
};
// "open_mesh", "flipped_facets", ...
std::string ToString(MeshDefect defect);

struct MeshFinding {
  MeshDefect defect = MeshDefect::kOpenMesh;
  int count = 0;                        // of edges, facets, pairs of facets, or vertices
  double extent = 0;                    // m of edge or m2 of facet; 0 where it has none
  std::vector<int> facets;              // the first few
  std::vector<Eigen::Vector3d> places;  // of them
  bool affects_light = false;           // false: nothing needs to be done
  std::string message;                  // what, how much, where
  std::string effect;                   // on the result
  std::string remedy;
};

std::vector<MeshFinding> CheckMesh(const Scene& scene);

// Of the rays between surfaces (RaySharesOf in forward/factors/form_factors.h).
struct RayShares {
  double escaped = 0;  // left the scene
  double back = 0;     // met the back of a facet
};

// Judges the findings by what rays saw: an open edge affects the light if rays leave the room, and holes and
// backs that only rays saw become findings. Elements that see nothing of the room do not count: the back of a
// cabinet that stands flush with the wall lies outside.
std::vector<MeshFinding> WithRayShares(std::vector<MeshFinding> findings, const RayShares& shares);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_MESH_CHECK_H_
