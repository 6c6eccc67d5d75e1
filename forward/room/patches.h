// Cuts the scene into patches, which send light, and their elements, which receive it.
//
// Facets are cut into congruent patches no larger than patch_size_m, and those into elements no larger than
// element_size_m. A patch lies in one facet, so it never straddles materials. Its elements are numbered
// consecutively. A patch is halved where a solid stands on it or where `must_split` asks for it, until
// neither holds or it is a single element.
//
// Models let solids stand on larger faces (a cabinet against its wall). The part of a face inside a solid
// sees only the backs of facets, while a single sheet encloses nothing
// (forward/room/internal/inside_solid.h). Elements that are wholly inside are left out. Elements partly
// inside count with their free share of area. Where a surface covers facets in part (Scene::surface), cells that it does not
// reach have no element, and those that it covers in part count with that part: as a rectangle of its area where it nearly
// fills one, otherwise as an element that is not whole.
//
// Lengths are in m, areas in m2, in the world frame.
// Source: Cohen, Greenberg, Immel, Brock (1986), "An efficient radiosity approach for realistic image
// synthesis" (substructuring into patches and elements).
#ifndef LUXFIT_FORWARD_ROOM_PATCHES_H_
#define LUXFIT_FORWARD_ROOM_PATCHES_H_

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "forward/room/scene.h"
#include "forward/room/visibility.h"

namespace luxfit {

struct Patch {
  Eigen::Vector3d center;
  // Corner and edges; a triangle where the facet is one (a flipped one has negative edges).
  Eigen::Vector3d origin, edge_u, edge_v;
  double area_m2 = 0;    // its free share
  bool is_whole = true;  // all of it is free
  int facet = 0;
  int material = 0;
  int first_element = 0;
  int element_count = 0;
  int cluster =
      0;  // of up to 2 x 2 neighbours in one facet; clusters are numbered from 0 in the order of the patches
};

struct Element {
  Eigen::Vector3d center;
  Eigen::Vector3d normal;
  // Corner and edges; a triangle where the facet is one (a flipped one has negative edges).
  Eigen::Vector3d origin, edge_u, edge_v;
  double area_m2 = 0;  // its free share
  bool is_whole = true;
  int patch = 0;
};

struct PatchesOptions {
  double patch_size_m = 0.4;    // indirect light varies slowly
  double element_size_m = 0.1;  // direct light and shadows vary fast
  // Tells whether the elements of a patch of a facet differ too much to send light as one
  // (forward/light/internal/adaptive_patches.h).
  std::function<bool(int facet, const std::vector<Element>&)> must_split = nullptr;
};

// Describes the grid of cells of one facet.
struct FacetGrid {
  int cells_u = 0, cells_v = 0;
  int halves = 1;                    // 2: triangles
  std::vector<int> element_of_cell;  // by Index; -1: none

  // Returns the number of cell (i, j); for triangles, of its lower or upper half.
  size_t Index(int i, int j, bool upper) const {
    const size_t cell = static_cast<size_t>(j) * static_cast<size_t>(cells_u) + static_cast<size_t>(i);
    return cell * static_cast<size_t>(halves) + (upper ? 1 : 0);
  }
};

struct Patches {
  std::vector<Patch> patches;
  std::vector<Element> elements;
  std::vector<FacetGrid> grids;  // one per facet
  std::vector<Facet> facets;     // those of the scene

  const Facet& FacetOf(int patch) const {
    return facets[static_cast<size_t>(patches[static_cast<size_t>(patch)].facet)];
  }
  bool IsTriangle(int patch) const { return FacetOf(patch).kind == FacetKind::kTriangle; }
  // Returns the patch to which an element belongs.
  const Patch& PatchOf(int element) const {
    return patches[static_cast<size_t>(elements[static_cast<size_t>(element)].patch)];
  }
  // Returns the element that holds point (u, v) of a facet; -1 where that lies inside a solid.
  int ElementAt(int facet, double u, double v) const;
};

// Returns the points at the quarters of an element (of a triangle: pulled into it), where shadows are tested.
std::vector<Eigen::Vector3d> ProbesOf(const Element& element, bool triangle);

// Subdivides the scene, whose rays `rays` are. Throws std::invalid_argument unless 0 < element_size_m <=
// patch_size_m, and for a scene that is not valid.
Patches Subdivide(const Scene& scene, const RayScene& rays, const PatchesOptions& options = {});

// Counts what Subdivide would make, but for what solids split, without making it.
struct PatchCounts {
  double patches = 0, elements = 0;
};
PatchCounts CountPatches(const Scene& scene, const PatchesOptions& sizes);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_PATCHES_H_
