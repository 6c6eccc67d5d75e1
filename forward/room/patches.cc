#include "forward/room/patches.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/room/internal/expect_valid.h"
#include "forward/room/internal/inside_solid.h"

namespace luxfit {
namespace {

int CountFor(double length, double size) {
  return std::max(1, static_cast<int>(std::ceil(length / size - 1e-9)));
}

// Names a cell of a grid over a facet: the parallelogram (i, j), or its lower or upper triangle.
struct Cell {
  int i, j;
  bool upper;
};

struct Place {
  Eigen::Vector3d origin, edge_u, edge_v;
};

Place PlaceOf(const Facet& facet, const Cell& cell, int cells_u, int cells_v) {
  const double du = 1.0 / cells_u, dv = 1.0 / cells_v;
  // An upper triangle is the one opposite the cell's far corner.
  if (cell.upper)
    return {facet.PointAt((cell.i + 1) * du, (cell.j + 1) * dv), -du * facet.edge_u, -dv * facet.edge_v};
  return {facet.PointAt(cell.i * du, cell.j * dv), du * facet.edge_u, dv * facet.edge_v};
}

Element MakeElement(const Facet& facet, const Place& place) {
  Element element;
  element.normal = facet.Normal();
  element.origin = place.origin;
  element.edge_u = place.edge_u;
  element.edge_v = place.edge_v;
  const bool triangle = facet.kind == FacetKind::kTriangle;
  element.center = element.origin + (triangle ? 1.0 / 3 : 0.5) * (element.edge_u + element.edge_v);
  element.area_m2 = (triangle ? 0.5 : 1.0) * element.edge_u.cross(element.edge_v).norm();
  return element;
}

// Returns the share of an element that is not inside a solid, by points spread over it.
double FreeShare(const Scene& scene, const RayScene& rays, const Element& element, bool triangle) {
  constexpr int kSide = 4;
  int free = 0, total = 0;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const double u = (i + 0.41) / kSide, v = (j + 0.57) / kSide;
      if (triangle && u + v > 1) continue;
      const Eigen::Vector3d p = element.origin + u * element.edge_u + v * element.edge_v;
      ++total;
      if (!IsInsideSolid(scene, rays, p, element.normal)) ++free;
    }
  }
  return static_cast<double>(free) / total;
}

// Returns the cells of a triangular grid, refined m-fold, within sub-triangle `patch` of the facet.
std::vector<Cell> CellsOfTrianglePatch(const Cell& patch, int m) {
  std::vector<Cell> cells;
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i + j < m; ++i) {
      const int base_i = patch.i * m, base_j = patch.j * m;
      if (!patch.upper) {
        cells.push_back({base_i + i, base_j + j, false});
        if (i + j < m - 1) cells.push_back({base_i + i, base_j + j, true});
      } else {  // mirrored through the middle of the patch's cell
        cells.push_back({base_i + m - 1 - i, base_j + m - 1 - j, true});
        if (i + j < m - 1) cells.push_back({base_i + m - 1 - i, base_j + m - 1 - j, false});
      }
    }
  }
  return cells;
}

// Pairs a cell of a facet with the share of it that is not inside a solid.
struct FreeCell {
  Element element;
  double share = 0;
};

class Subdivision {
 public:
  Subdivision(const Scene& scene, const RayScene& rays, const PatchesOptions& options)
      : scene_(scene), rays_(rays), options_(options) {
    for (size_t f = 0; f < scene.facets.size(); ++f) AddFacet(static_cast<int>(f));
  }
  Patches result;

 private:
  // Cells [i, i_end) x [j, j_end).
  struct Block {
    int i, i_end, j, j_end;
  };

  void AddFacet(int index) {
    const Facet& facet = scene_.facets[static_cast<size_t>(index)];
    const bool triangle = facet.kind == FacetKind::kTriangle;
    double length_u = facet.edge_u.norm(), length_v = facet.edge_v.norm();
    if (triangle) length_u = length_v = std::max({length_u, length_v, (facet.edge_u - facet.edge_v).norm()});
    const int patches_u = CountFor(length_u, options_.patch_size_m);
    const int patches_v = CountFor(length_v, options_.patch_size_m);
    const int elements_u = CountFor(length_u / patches_u, options_.element_size_m);
    const int elements_v = CountFor(length_v / patches_v, options_.element_size_m);
    FacetGrid grid;
    grid.cells_u = patches_u * elements_u;
    grid.cells_v = patches_v * elements_v;
    grid.halves = triangle ? 2 : 1;
    grid.element_of_cell.assign(grid.Index(0, grid.cells_v, false), -1);
    result.grids.push_back(grid);
    result.facets.push_back(facet);
    free_cells_.assign(grid.element_of_cell.size(), {});
    for (int j = 0; j < patches_v; ++j) {
      for (int i = 0; i < patches_u; ++i) {
        const int left = i * elements_u, low = j * elements_v;
        if (!triangle) {
          AddBlock({left, left + elements_u, low, low + elements_v});
        } else if (i + j < patches_u) {
          AddTriangle(PlaceOf(facet, {i, j, false}, patches_u, patches_v),
                      CellsOfTrianglePatch({i, j, false}, elements_u));
          if (i + j < patches_u - 1)
            AddTriangle(PlaceOf(facet, {i, j, true}, patches_u, patches_v),
                        CellsOfTrianglePatch({i, j, true}, elements_u));
        }
      }
    }
  }

  void AddBlock(const Block& block) {
    const Facet& facet = result.facets.back();
    const FacetGrid& grid = result.grids.back();
    std::vector<Cell> cells;
    for (int j = block.j; j < block.j_end; ++j) {
      for (int i = block.i; i < block.i_end; ++i) cells.push_back({i, j, false});
    }
    Find(cells);
    const int width = block.i_end - block.i, height = block.j_end - block.j;
    if (cells.size() == 1 || !MustSplit(cells)) {
      Place place = PlaceOf(facet, {block.i, block.j, false}, grid.cells_u, grid.cells_v);
      place.edge_u *= width;
      place.edge_v *= height;
      return AddPatch(place, cells);
    }
    const bool along_u = height == 1 || (width > 1 && width * facet.edge_u.norm() / grid.cells_u >=
                                                          height * facet.edge_v.norm() / grid.cells_v);
    Block first = block, second = block;
    if (along_u) {
      first.i_end = second.i = block.i + width / 2;
    } else {
      first.j_end = second.j = block.j + height / 2;
    }
    AddBlock(first);
    AddBlock(second);
  }

  void AddTriangle(const Place& place, const std::vector<Cell>& cells) {
    Find(cells);
    if (cells.size() == 1 || !MustSplit(cells)) return AddPatch(place, cells);
    const FacetGrid& grid = result.grids.back();
    for (const Cell& cell : cells)
      AddPatch(PlaceOf(result.facets.back(), cell, grid.cells_u, grid.cells_v), {cell});
  }

  FreeCell& At(const Cell& cell) {
    return free_cells_[result.grids.back().Index(cell.i, cell.j, cell.upper)];
  }

  void Find(const std::vector<Cell>& cells) {
    const Facet& facet = result.facets.back();
    const FacetGrid& grid = result.grids.back();
    for (const Cell& cell : cells) {
      FreeCell& free = At(cell);
      if (free.element.area_m2 > 0) continue;  // found on an earlier level
      free.element = MakeElement(facet, PlaceOf(facet, cell, grid.cells_u, grid.cells_v));
      free.share = FreeShare(scene_, rays_, free.element, facet.kind == FacetKind::kTriangle);
      free.element.is_whole = free.share == 1;
    }
  }

  // A patch that a solid stands on would carry light from one of its sides to the other.
  bool MustSplit(const std::vector<Cell>& cells) {
    std::vector<Element> free;
    for (const Cell& cell : cells) {
      if (At(cell).share > 0) free.push_back(At(cell).element);
    }
    if (free.empty()) return false;
    const bool whole = free.size() == cells.size() &&
                       std::all_of(free.begin(), free.end(), [](const Element& e) { return e.is_whole; });
    const int facet = static_cast<int>(result.facets.size()) - 1;
    return !whole || (options_.must_split && options_.must_split(facet, free));
  }

  void AddPatch(const Place& place, const std::vector<Cell>& cells) {
    const int facet = static_cast<int>(result.facets.size()) - 1;
    FacetGrid& grid = result.grids.back();
    Patch patch;
    patch.facet = facet;
    patch.material = result.facets.back().material;
    patch.origin = place.origin;
    patch.edge_u = place.edge_u;
    patch.edge_v = place.edge_v;
    patch.first_element = static_cast<int>(result.elements.size());
    patch.center.setZero();
    for (const Cell& cell : cells) {
      Element element = At(cell).element;
      const double share = At(cell).share;
      patch.is_whole = patch.is_whole && element.is_whole;
      if (share == 0) continue;
      element.patch = static_cast<int>(result.patches.size());
      element.area_m2 *= share;
      grid.element_of_cell[grid.Index(cell.i, cell.j, cell.upper)] = static_cast<int>(result.elements.size());
      patch.area_m2 += element.area_m2;
      patch.center += element.area_m2 * element.center;
      ++patch.element_count;
      result.elements.push_back(element);
    }
    if (patch.element_count == 0) return;
    patch.center /= patch.area_m2;
    result.patches.push_back(patch);
  }

  const Scene& scene_;
  const RayScene& rays_;
  const PatchesOptions& options_;
  std::vector<FreeCell> free_cells_;  // those of the facet at hand
};

}  // namespace

int Patches::ElementAt(int facet, double u, double v) const {
  const FacetGrid& grid = grids[static_cast<size_t>(facet)];
  const double x = u * grid.cells_u, y = v * grid.cells_v;
  int i = std::clamp(static_cast<int>(x), 0, grid.cells_u - 1);
  int j = std::clamp(static_cast<int>(y), 0, grid.cells_v - 1);
  if (facets[static_cast<size_t>(facet)].kind == FacetKind::kParallelogram) {
    return grid.element_of_cell[grid.Index(i, j, false)];
  }
  bool upper = (x - i) + (y - j) > 1;
  if (i + j >= grid.cells_u) i = grid.cells_u - 1 - j;  // rounding past the hypotenuse
  if (i + j == grid.cells_u - 1) upper = false;
  return grid.element_of_cell[grid.Index(i, j, upper)];
}

Patches Subdivide(const Scene& scene, const RayScene& rays, const PatchesOptions& options) {
  if (!(options.element_size_m > 0) || !(options.patch_size_m >= options.element_size_m)) {
    throw std::invalid_argument("Subdivide: expected 0 < element_size_m <= patch_size_m");
  }
  ExpectValid(scene);
  return Subdivision(scene, rays, options).result;
}

std::vector<Eigen::Vector3d> ProbesOf(const Element& element, bool triangle) {
  const double scale = triangle ? 2.0 / 3 : 1.0;
  std::vector<Eigen::Vector3d> probes;
  for (const double u : {0.25, 0.75}) {
    for (const double v : {0.25, 0.75}) {
      if (triangle && u + v > 1) continue;
      probes.push_back(element.origin + scale * u * element.edge_u + scale * v * element.edge_v);
    }
  }
  return probes;
}

}  // namespace luxfit
