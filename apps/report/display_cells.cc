#include "apps/report/display_cells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

namespace luxfit {
namespace {

Eigen::Array2i GridOf(const FacetGrid& grid, int merged) {
  return {std::max(1, (grid.cells_u + merged - 1) / merged),
          std::max(1, (grid.cells_v + merged - 1) / merged)};
}

long long CountOf(const Patches& patches, int merged) {
  long long count = 0;
  for (const FacetGrid& grid : patches.grids) {
    const Eigen::Array2i cells = GridOf(grid, merged);
    count += static_cast<long long>(cells[0]) * cells[1];
  }
  return count;
}

int LargestGrid(const Patches& patches) {
  int largest = 1;
  for (const FacetGrid& grid : patches.grids) largest = std::max({largest, grid.cells_u, grid.cells_v});
  return largest;
}

int LeastMerge(const Patches& patches, int max_cells) {
  if (static_cast<long long>(patches.elements.size()) <= max_cells) return 1;
  // The count falls with every step: halving finds the first that is small enough.
  int low = 1, high = LargestGrid(patches);
  while (low < high) {
    const int middle = (low + high) / 2;
    if (CountOf(patches, middle) <= max_cells) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

struct GridPlace {
  int i = 0, j = 0;
  bool is_upper = false;
};

GridPlace PlaceOf(const Eigen::Vector2d& uv, const Eigen::Array2i& grid, bool triangle) {
  const double u = uv[0] * grid[0], v = uv[1] * grid[1];
  GridPlace place;
  place.i = std::clamp(static_cast<int>(std::floor(u)), 0, grid[0] - 1);
  place.j = std::clamp(static_cast<int>(std::floor(v)), 0, grid[1] - 1);
  place.is_upper = triangle && (u - place.i) + (v - place.j) > 1;
  return place;
}

Eigen::Vector2d CentreOf(const DisplayCell& cell, const Eigen::Array2i& grid, bool triangle) {
  const double in_cell = triangle ? (cell.is_upper ? 2.0 / 3 : 1.0 / 3) : 0.5;
  return {(cell.i + in_cell) / grid[0], (cell.j + in_cell) / grid[1]};
}

// Returns all cells of one facet, without their elements.
std::vector<DisplayCell> CellsOf(int facet, const Eigen::Array2i& grid, bool triangle) {
  std::vector<DisplayCell> cells;
  for (int j = 0; j < grid[1]; ++j) {
    for (int i = 0; i < grid[0]; ++i) {
      if (!triangle || i + j < grid[0]) cells.push_back({facet, i, j, false, {}});
      if (triangle && i + j + 1 < grid[0]) cells.push_back({facet, i, j, true, {}});
    }
  }
  return cells;
}

}  // namespace

DisplayCells MergeForDisplay(const Patches& patches, int max_cells) {
  if (max_cells < 1) throw std::invalid_argument("MergeForDisplay: expected max_cells >= 1");
  DisplayCells display;
  display.merged = LeastMerge(patches, max_cells);
  std::vector<std::vector<int>> elements_of(patches.facets.size());
  for (size_t e = 0; e < patches.elements.size(); ++e) {
    const Patch& patch = patches.PatchOf(static_cast<int>(e));
    elements_of[static_cast<size_t>(patch.facet)].push_back(static_cast<int>(e));
  }
  for (size_t f = 0; f < patches.facets.size(); ++f) {
    const Facet& facet = patches.facets[f];
    const bool triangle = facet.kind == FacetKind::kTriangle;
    const Eigen::Array2i grid = GridOf(patches.grids[f], display.merged);
    display.grids.push_back(grid);
    std::map<std::tuple<int, int, bool>, std::vector<int>> members;
    for (const int e : elements_of[f]) {
      const Eigen::Vector2d uv = facet.CoordinatesOf(patches.elements[static_cast<size_t>(e)].center);
      const GridPlace place = PlaceOf(uv, grid, triangle);
      members[{place.i, place.j, place.is_upper}].push_back(e);
    }
    for (DisplayCell& cell : CellsOf(static_cast<int>(f), grid, triangle)) {
      cell.elements = members[{cell.i, cell.j, cell.is_upper}];
      const Eigen::Vector2d centre = CentreOf(cell, grid, triangle);
      const int under =
          cell.elements.empty() ? patches.ElementAt(static_cast<int>(f), centre[0], centre[1]) : -1;
      if (under >= 0) cell.elements.push_back(under);
      if (!cell.elements.empty()) display.cells.push_back(std::move(cell));
    }
  }
  return display;
}

Eigen::MatrixXd CellMeans(const Patches& patches, const DisplayCells& display,
                          const Eigen::MatrixXd& values) {
  if (values.rows() != static_cast<Eigen::Index>(patches.elements.size()))
    throw std::invalid_argument("CellMeans: expected one row an element");
  Eigen::MatrixXd means =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(display.cells.size()), values.cols());
  for (size_t c = 0; c < display.cells.size(); ++c) {
    double area = 0;
    const Eigen::Index row = static_cast<Eigen::Index>(c);
    for (const int e : display.cells[c].elements) {
      const double element_m2 = patches.elements[static_cast<size_t>(e)].area_m2;
      means.row(row) += element_m2 * values.row(e);
      area += element_m2;
    }
    if (area > 0) means.row(row) /= area;
  }
  return means;
}

}  // namespace luxfit
