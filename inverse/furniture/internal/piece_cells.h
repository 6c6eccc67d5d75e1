// Samples the faces of a piece of furniture at places a few centimetres apart.
//
// Faces narrower than kNarrowM, and a rim of kRimOfFaceM along edges, are left out: a pixel there mixes two surfaces.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_PIECE_CELLS_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_PIECE_CELLS_H_

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

constexpr double kNarrowM = 0.1, kRimOfFaceM = 0.03;

struct PieceCell {
  Eigen::Vector3d place, normal;
  double area_m2 = 0;
};

// Returns the cells of facets of the scene, of about cell_m x cell_m.
inline std::vector<PieceCell> CellsOf(const Scene& scene, const std::vector<int>& facets, double cell_m) {
  std::vector<PieceCell> cells;
  for (const int f : facets) {
    const Facet& facet = scene.facets[static_cast<size_t>(f)];
    const double area_m2 = facet.edge_u.cross(facet.edge_v).norm();
    const double across_v = area_m2 / facet.edge_v.norm(), across_u = area_m2 / facet.edge_u.norm();
    if (std::min(across_u, across_v) < kNarrowM) continue;
    const double rim_u = kRimOfFaceM / across_v, rim_v = kRimOfFaceM / across_u;
    const auto columns = std::max(1L, std::lround((across_v - 2 * kRimOfFaceM) / cell_m));
    const auto rows = std::max(1L, std::lround((across_u - 2 * kRimOfFaceM) / cell_m));
    const double du = (1 - 2 * rim_u) / static_cast<double>(columns),
                 dv = (1 - 2 * rim_v) / static_cast<double>(rows);
    for (long row = 0; row < rows; ++row) {
      for (long column = 0; column < columns; ++column) {
        const double u = rim_u + (static_cast<double>(column) + 0.5) * du,
                     v = rim_v + (static_cast<double>(row) + 0.5) * dv;
        if (facet.kind == FacetKind::kTriangle && u + v > 1 - rim_u - rim_v) continue;
        cells.push_back({facet.PointAt(u, v), facet.Normal(), du * dv * area_m2});
      }
    }
  }
  return cells;
}

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_PIECE_CELLS_H_
