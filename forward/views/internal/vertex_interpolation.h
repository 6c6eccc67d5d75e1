// Interpolates light that is known at elements, continuously over each surface.
//
//   value(u, v) = sum over the corners of the cell: share(u, v) * vertex value
//   vertex value = mean of the elements round it, extrapolated linearly at borders
//
// This is the classical rule of radiosity. Shares are bilinear in parallelograms, barycentric in triangles.
// Facets of one material in one plane that share a vertex share its value. Nothing is carried over a crease,
// over a change of material, or into a solid.
//
// At a vertex that elements do not surround, a plane is fitted by least squares to the elements round it and
// round its neighbours. Its value there is the vertex value, so a linear field is reproduced everywhere. A
// positive field can become slightly negative at a border: clamp where that matters.
//
// Columns of the matrices are independent quantities (channels, luminaires).
// Source: Cohen and Greenberg (1985), "The hemi-cube: a radiosity solution for complex environments", sec. 5;
// Cohen, Greenberg, Immel, Brock (1986).
#ifndef LUXFIT_FORWARD_VIEWS_INTERNAL_VERTEX_INTERPOLATION_H_
#define LUXFIT_FORWARD_VIEWS_INTERNAL_VERTEX_INTERPOLATION_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "forward/room/patches.h"
#include "forward/room/scene.h"

namespace luxfit {

// Describes the corners of one facet's cells.
struct VertexLattice {
  int cells_u = 0, cells_v = 0;
  bool triangle = false;
  std::vector<int> vertex_of_corner;  // (cells_u + 1) x (cells_v + 1), u fastest; -1: no element touches it

  size_t Index(int i, int j) const {
    return static_cast<size_t>(j) * static_cast<size_t>(cells_u + 1) + static_cast<size_t>(i);
  }
};

struct VertexShare {
  int vertex = -1;  // -1: unused
  float share = 0;
};

struct VertexInterpolation {
  std::vector<VertexLattice> lattices;  // one per facet
  // Vertex v is the sum of weight[k] times element[k], k from first[v] to first[v + 1].
  std::vector<size_t> first;
  std::vector<int> element;
  std::vector<float> weight;

  Eigen::Index VertexCount() const { return static_cast<Eigen::Index>(first.size()) - 1; }
};
VertexInterpolation MakeVertexInterpolation(const Scene& scene, const Patches& patches);

// Returns vertices x columns from elements x columns.
Eigen::MatrixXf AtVertices(const VertexInterpolation& interpolation, const Eigen::MatrixXf& at_elements);

// Returns the vertices that make up a point of a facet. Shares sum to 1, or to 0 where no vertex is near (in
// a solid).
std::array<VertexShare, 4> VerticesAt(const VertexInterpolation& interpolation, int facet, double u,
                                      double v);

// Returns one row: the columns of `at_vertices` at a point of a facet.
Eigen::RowVectorXf Interpolate(const VertexInterpolation& interpolation, const Eigen::MatrixXf& at_vertices,
                               int facet, double u, double v);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_VIEWS_INTERNAL_VERTEX_INTERPOLATION_H_
