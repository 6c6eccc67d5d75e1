// Finds how facets hang together: shared vertices, edges, and shells.
//
// Vertices within 20 um of one another are one, edges join facets, and facets joined by edges of exactly two
// facets form a shell.
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_MESH_TOPOLOGY_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_MESH_TOPOLOGY_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

constexpr double kWeldM = 2e-5;

// Describes a side of a facet, from vertex a to vertex b > a. `reversed`: the facet itself runs from b to a.
struct FacetEdge {
  int a = 0, b = 0;
  int facet = 0;
  bool reversed = false;
};

struct MeshTopology {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 4>> corners;  // one entry for each facet; the last -1 for triangles
  std::vector<FacetEdge> edges;             // sorted by (a, b): those of one line stand together
};
MeshTopology MakeTopology(const Scene& scene);

// Calls use(first, last) for each run of edges between the same two vertices.
template <typename Use>
void ForEachEdge(const MeshTopology& mesh, const Use& use) {
  for (size_t first = 0, last; first < mesh.edges.size(); first = last) {
    for (last = first + 1; last < mesh.edges.size() && mesh.edges[last].a == mesh.edges[first].a &&
                           mesh.edges[last].b == mesh.edges[first].b;) {
      ++last;
    }
    use(first, last);
  }
}

struct Shells {
  std::vector<int> of_facet;
  std::vector<bool> turned;      // by facet: wound against the shell's first facet
  std::vector<bool> closed;      // by shell: every edge joins as many facets one way as the other
  std::vector<bool> orientable;  // by shell
};
Shells FindShells(const MeshTopology& mesh);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_MESH_TOPOLOGY_H_
