// Groups the triangles of a mesh into regions that lie on planes.
//
// A region grows from the flattest triangle that is left over its neighbours, and takes those whose corners lie within
// `off_plane_m` of its plane and whose normals, averaged with those of neighbours that hardly turn, lie within 40 degrees
// of the plane's. The plane is that of total least squares, weighted by area; it is fitted anew as the region doubles, and
// once it is grown the region grows again with it. Regions below a hundredth of a square metre join the neighbour of the
// longest common border that they hardly leave. Regions hold one material.
//
// Source: Rabbani, van den Heuvel, Vosselman (2006), "Segmentation of point clouds using smoothness constraint".
#ifndef LUXFIT_FORWARD_MESH_INTERNAL_GROW_PLANES_H_
#define LUXFIT_FORWARD_MESH_INTERNAL_GROW_PLANES_H_

#include <Eigen/Core>
#include <vector>

#include "forward/mesh/internal/scan_mesh.h"

namespace luxfit {

// n . x = offset, m; the normal points to the front.
struct Plane {
  Eigen::Vector3d normal{0, 0, 1};
  double offset_m = 0;

  double Above(const Eigen::Vector3d& p) const { return normal.dot(p) - offset_m; }
};

struct PlanarRegions {
  std::vector<int> of_triangle;
  std::vector<Plane> planes;    // by region
  std::vector<double> area_m2;  // by region
  std::vector<int> material;    // by region
};
PlanarRegions GrowPlanes(const ScanMesh& mesh, double off_plane_m);

// Returns the regions with small ones gathered: those of one cell of space and one material that face alike (up, down, or one
// of four sides) lie on one plane, whether they hang together or not. What is farther from it moves onto it.
PlanarRegions GatherSmall(const ScanMesh& mesh, const PlanarRegions& regions, double cell_m);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_INTERNAL_GROW_PLANES_H_
