// Holds a mesh as triangles that know their neighbours.
//
// Vertices within 20 um are one. Parallelograms are cut in two. Metres, world frame.
#ifndef LUXFIT_FORWARD_MESH_INTERNAL_SCAN_MESH_H_
#define LUXFIT_FORWARD_MESH_INTERNAL_SCAN_MESH_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

struct ScanMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;  // counter-clockwise seen from the front
  std::vector<int> material;                  // by triangle
  std::vector<int> facet;                     // by triangle of the scene: the facet that it is of
  std::vector<std::array<int, 3>>
      across;  // by triangle: the neighbour at side k, corners k and k + 1; -1: none

  const Eigen::Vector3d& Corner(size_t triangle, size_t k) const {
    return vertices[static_cast<size_t>(triangles[triangle][k])];
  }
  // Returns the normal, as long as twice the area.
  Eigen::Vector3d AreaNormal(size_t t) const {
    return (Corner(t, 1) - Corner(t, 0)).cross(Corner(t, 2) - Corner(t, 0));
  }
};

ScanMesh MakeScanMesh(const Scene& scene);

// Adds a triangle unless it has no area, and tells whether it did. FindNeighbours makes `across` anew afterwards.
bool AddTriangle(int a, int b, int c, int material, ScanMesh& mesh);
void FindNeighbours(ScanMesh& mesh);

// Names side k of a triangle, from vertex `from` to vertex `to`.
struct Side {
  int from = 0, to = 0, triangle = 0, k = 0;
};

// Returns the rims of holes: loops of sides that no other triangle shares. Loops that touch at a vertex come apart there.
std::vector<std::vector<Side>> RimsOf(const ScanMesh& mesh);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_INTERNAL_SCAN_MESH_H_
