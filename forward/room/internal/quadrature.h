// Returns the nodes of Gauss quadrature over a line, a parallelogram and a triangle; weights sum to 1.
//
// The line's rule is Gauss-Legendre on [0, 1], exact to degree 2n - 1; the parallelogram's rule is its
// product. The triangle's rule (u, v >= 0, u + v <= 1) is Stroud's conical product of Gauss-Legendre and
// Gauss-Jacobi(1, 0), exact to degree 2n - 1 as well.
//
// Throws std::invalid_argument for n < 1. Source: Golub and Welsch (1969), "Calculation of Gauss quadrature
// rules"; Stroud (1971), "Approximate Calculation of Multiple Integrals", sec. 2.4.
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_QUADRATURE_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_QUADRATURE_H_

#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

struct LineNode {
  double t = 0, weight = 1;
};
std::vector<LineNode> GaussLegendre(int n);

struct FacetNode {
  double u = 0, v = 0, weight = 1;
};
std::vector<FacetNode> FacetRule(FacetKind kind, int n);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_QUADRATURE_H_
