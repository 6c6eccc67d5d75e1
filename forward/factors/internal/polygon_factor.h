// Form factors in closed form, nothing standing between.
//
//   point to polygon     F = 1/(2 pi) sum_k angle_k n . (a_k x b_k) / |a_k x b_k|        (Lambert)
//   polygon to polygon   F = 1/(2 pi A_1) oint_1 oint_2 ln r  dr_1 . dr_2                 (Stokes)
//
// a_k, b_k: from the point to the ends of edge k. Shares in [0, 1], metres. Vertices run counter-clockwise
// seen from the front; a polygon sends and receives on its front only, and what lies behind the other's plane
// is cut off first. In the double contour integral the inner edge has its closed form and the outer one
// adaptive Gauss-Kronrod quadrature to 1e-9, so that polygons with a common edge or corner (where 1 / r^2 has
// no bound) are as exact as distant ones.
//
// Undefined for a point in the plane of the polygon and inside it. NaN in is NaN out. Sources: Lambert
// (1760), "Photometria"; Baum, Rushmeier, Winget (1989), "Improving radiosity solutions through the use of
// analytically determined form-factors", eq. 3; Schroeder and Hanrahan (1993), "On the form factor between
// two polygons"; Shapiro (1985), J. Heat Transfer 107, 730 (contour integrals of touching surfaces).
#ifndef LUXFIT_FORWARD_FACTORS_INTERNAL_POLYGON_FACTOR_H_
#define LUXFIT_FORWARD_FACTORS_INTERNAL_POLYGON_FACTOR_H_

#include <Eigen/Core>
#include <array>

#include "forward/room/patches.h"

namespace luxfit {

// Convex and planar; at most 8 corners.
struct ConvexPolygon {
  std::array<Eigen::Vector3d, 8> vertices;
  int count = 0;

  void Add(const Eigen::Vector3d& p) { vertices[static_cast<size_t>(count++)] = p; }
  const Eigen::Vector3d& operator[](int i) const { return vertices[static_cast<size_t>(i)]; }
};

// The parallelogram or triangle origin, edge_u, edge_v.
ConvexPolygon MakePolygon(const Eigen::Vector3d& origin, const Eigen::Vector3d& edge_u,
                          const Eigen::Vector3d& edge_v, FacetKind kind);

// The part of a polygon in front of the plane through p.
ConvexPolygon InFrontOf(const ConvexPolygon& polygon, const Eigen::Vector3d& p,
                        const Eigen::Vector3d& normal);

// Share of the cosine-weighted hemisphere over a point that a polygon covers.
double PointToPolygon(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, const ConvexPolygon& polygon);

// The same with its gradient with respect to each corner of the polygon (1/m), whether or not the point's
// plane cuts it.
struct PolygonGradient {
  double factor = 0;
  std::array<Eigen::Vector3d, 8> d_vertex;
};
PolygonGradient PointToPolygonGradient(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                                       const ConvexPolygon& polygon);

// Share of what polygon `from` sends that polygon `to` receives.
double PolygonToPolygon(const ConvexPolygon& from, const ConvexPolygon& to);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_INTERNAL_POLYGON_FACTOR_H_
