// Finds the defects of a mesh, says what each does to the light and how to fix it, and cuts away overlaps.
//
// Defects that can change the light are open edges (m of edge that no other facet closes), facets wound
// against their neighbours, shells that are inside out, duplicates and coplanar overlaps (m2). Rooms must
// face inwards, solids in them outwards. Slivers, edges of three or more facets and T-junctions look odd but
// change nothing. Form factors by rays need no shared vertices, so T-junctions and slivers never affect the
// light.
//
// Vertices within 20 um are one. Solids may stand on larger faces (forward/room/patches.h): an edge that runs
// over another facet is closed by that facet. The cost is nearly linear: 1e5 facets take less than a second.
//
// An overlap is facets drawn on one another: in one plane, facing the same way. A floor drawn twice, or a rug
// at the floor's own height, would emit twice though light can only meet one of them. After the cut every
// point of a plane belongs to one facet. The facet on top is the one whose material has the lesser area in
// that plane (a rug on a floor, a door in a wall); among equal ones, the first. Facets that face opposite
// ways are no overlap: they are a sheet with two sides, or a solid that stands on a larger face. Overlaps
// narrower than 20 um are rounding of the file and stay. Areas are in m2.
//
// CheckSurvey tells whether surveyed points on surfaces and the mesh have the same frame and unit. Points are
// near the mesh where they have. A mesh in another unit than declared is off by a known factor, and one whose
// y axis is up by a known turn.
//
// Source: Baum, Mann, Smith, Winget (1991), "Making radiosity usable: automatic preprocessing and meshing
// techniques for the generation of accurate radiosity solutions"; solid angle of a triangle: Van Oosterom and
// Strackee (1983); clipping: Sutherland and Hodgman (1974), "Reentrant polygon clipping".
#ifndef LUXFIT_FORWARD_MESH_MESH_CHECK_H_
#define LUXFIT_FORWARD_MESH_MESH_CHECK_H_

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
// Returns the name of a defect: "open_mesh", "flipped_facets", ...
std::string ToString(MeshDefect defect);

struct MeshFinding {
  MeshDefect defect = MeshDefect::kOpenMesh;
  int count = 0;                        // number of edges, facets, pairs of facets, or vertices
  double extent = 0;                    // m of edge or m2 of facet; 0 where it has none
  std::vector<int> facets;              // the first few
  std::vector<Eigen::Vector3d> places;  // the places of these facets
  bool affects_light = false;           // false: nothing needs to be done
  std::string message;                  // what, how much, where
  std::string effect;                   // what it does to the result
  std::string remedy;
};

// Returns what is wrong with the scene as a mesh; empty where nothing is.
std::vector<MeshFinding> CheckMesh(const Scene& scene);

// Holds the shares of the rays between surfaces that were lost (RaySharesOf in
// forward/factors/form_factors.h).
struct RayShares {
  double escaped = 0;  // left the scene
  double back = 0;     // met the back of a facet
};

// Judges the findings by what rays saw. An open edge affects the light if rays leave the room. Holes and
// backs that only rays saw become findings. Elements that see nothing of the room do not count: the back of a
// cabinet that stands flush with the wall lies outside.
std::vector<MeshFinding> WithRayShares(std::vector<MeshFinding> findings, const RayShares& shares);

struct SurveyCheck {
  double distance_m = 0;    // three quarters of the points are no farther from the mesh
  bool fits = true;         // below tolerance_m
  std::string better_unit;  // m, cm, mm, in or ft where the mesh fits in that unit; else empty
  bool fits_y_up = false;   // the mesh fits where its (x, y, z) is taken as (x, -z, y)
};

// `declared_metres_per_unit`: the scale with which the mesh was read. Without points, `fits` is true.
SurveyCheck CheckSurvey(const Scene& scene, const std::vector<Eigen::Vector3d>& points_in_world,
                        double declared_metres_per_unit, double tolerance_m = 0.1);

struct FacetOverlap {
  int on_top = 0, below = 0;  // facets
  double area_m2 = 0;
};

// Returns the overlaps, ordered by the facet below.
std::vector<FacetOverlap> FindOverlaps(const Scene& scene);

// Returns the scene with what lies below another facet cut away. Where nothing overlaps it is unchanged,
// facet for facet.
Scene WithoutOverlaps(const Scene& scene);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_MESH_CHECK_H_
