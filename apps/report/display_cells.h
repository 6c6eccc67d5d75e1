// Merges elements into cells to draw, no more than a given number.
//
//   value(cell) = sum over its elements: area_e value_e / sum over its elements: area_e
//
// Every facet is cut anew into ceil(cells_u / s) x ceil(cells_v / s) congruent cells. s is the least whole
// number that keeps the count; s = 1 gives the elements themselves. An element belongs to the cell that its
// centre lies in. A cell without a centre takes the element under its own, and is left out where that lies in
// a solid. Facets are never joined: a scene of more facets than `max_cells` keeps one cell for each.
//
// Throws std::invalid_argument for max_cells < 1 and for values that have not one row per element.
#ifndef LUXFIT_APPS_REPORT_DISPLAY_CELLS_H_
#define LUXFIT_APPS_REPORT_DISPLAY_CELLS_H_

#include <Eigen/Core>
#include <vector>

#include "forward/room/patches.h"

namespace luxfit {

// Describes cell (i, j) of a facet's grid of cells_u x cells_v; on a triangle, its lower or its upper half.
struct DisplayCell {
  int facet = 0;
  int i = 0, j = 0;
  bool is_upper = false;
  std::vector<int> elements;
};

struct DisplayCells {
  std::vector<Eigen::Array2i> grids;  // cells_u, cells_v of every facet
  std::vector<DisplayCell> cells;     // by facet
  int merged = 1;                     // s
};
DisplayCells MergeForDisplay(const Patches& patches, int max_cells);

// Returns cells x columns, from elements x columns.
Eigen::MatrixXd CellMeans(const Patches& patches, const DisplayCells& display, const Eigen::MatrixXd& values);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_DISPLAY_CELLS_H_
