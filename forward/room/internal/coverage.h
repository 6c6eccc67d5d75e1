// Measures how triangles of a surface cover the cells of a grid over a facet.
//
//   area = sum of |triangle in cell|;  filled = area / |box of the covered part|         in units of cells
//
// Triangles of a surface do not overlap; where they do (sheets drawn twice), a cell counts as covered once.
// Source: Sutherland and Hodgman (1974), "Reentrant polygon clipping".
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_COVERAGE_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_COVERAGE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

struct CellCoverage {
  double area = 0;                                   // 1: all of the cell
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // of the covered part, in the grid's coordinates
  Eigen::AlignedBox2d box;                           // round the covered part, likewise

  double Filled() const {
    return box.isEmpty() || box.volume() <= 0 ? 0 : std::min(1.0, area / box.volume());
  }
};

// Returns the cells of a grid of cells_u x cells_v, row by row: cell (i, j) at j cells_u + i.
std::vector<CellCoverage> CoverageOf(const std::vector<SurfaceTriangle>& triangles, int cells_u, int cells_v);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_COVERAGE_H_
