#include "forward/room/patches.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "forward/room/internal/coverage.h"
#include "forward/room/internal/expect_valid.h"
#include "forward/room/internal/inside_solid.h"

namespace luxfit {
namespace {

// `slack`: share of a part by which the parts may be too long together.
int CountFor(double length, double size, double slack = 1e-9) {
  return std::max(1, static_cast<int>(std::ceil(length / size - slack)));
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

// Pairs a cell of a facet with the shares of its element that are surface and that are not inside a solid.
struct FreeCell {
  Element element;
  double covered = 1, free = 0;
  double Share() const { return covered * free; }
};

constexpr int kClusterSide = 2;  // patches

// An element that covers this much of the box round it counts as a rectangle of its area, and so does a patch, which is
// larger. What covers less than the least of a cell is part of the next one.
constexpr double kFillsElement = 0.4, kFillsPatch = 0.6, kLeastCovered = 0.1;

// Returns the rectangle of a share of a place, about its middle.
Place Shrunk(const Place& place, double share) {
  const double side = std::sqrt(share);
  return {place.origin + 0.5 * (1 - side) * (place.edge_u + place.edge_v), side * place.edge_u,
          side * place.edge_v};
}

class Subdivision {
 public:
  Subdivision(const Scene& scene, const RayScene& rays, const PatchesOptions& options)
      : scene_(scene), rays_(rays), options_(options) {
    std::vector<std::vector<SurfaceTriangle>> surface(scene.surface.empty() ? 0 : scene.facets.size());
    for (const SurfaceTriangle& triangle : scene.surface)
      surface[static_cast<size_t>(triangle.facet)].push_back(triangle);
    for (size_t f = 0; f < scene.facets.size(); ++f)
      AddFacet(static_cast<int>(f), surface.empty() ? nullptr : &surface[f]);
  }
  Patches result;

 private:
  // Cells [i, i_end) x [j, j_end).
  struct Block {
    int i, i_end, j, j_end;
  };

  // `surface`: what covers the facet; nullptr: all of it is covered.
  void AddFacet(int index, const std::vector<SurfaceTriangle>* surface) {
    const Facet& facet = scene_.facets[static_cast<size_t>(index)];
    const bool triangle = facet.kind == FacetKind::kTriangle;
    double length_u = facet.edge_u.norm(), length_v = facet.edge_v.norm();
    if (triangle) length_u = length_v = std::max({length_u, length_v, (facet.edge_u - facet.edge_v).norm()});
    const double slack = surface ? 0.1 : 1e-9;  // planes of a scan are known to centimetres
    const int patches_u = CountFor(length_u, options_.patch_size_m, slack);
    const int patches_v = CountFor(length_v, options_.patch_size_m, slack);
    const int elements_u = CountFor(length_u / patches_u, options_.element_size_m, slack);
    const int elements_v = CountFor(length_v / patches_v, options_.element_size_m, slack);
    FacetGrid grid;
    grid.cells_u = patches_u * elements_u;
    grid.cells_v = patches_v * elements_v;
    grid.halves = triangle ? 2 : 1;
    grid.element_of_cell.assign(grid.Index(0, grid.cells_v, false), -1);
    result.grids.push_back(grid);
    result.facets.push_back(facet);
    free_cells_.assign(grid.element_of_cell.size(), {});
    coverage_.clear();
    if (surface) coverage_ = CoverageOf(*surface, grid.cells_u, grid.cells_v);
    const int clusters_u = (patches_u + kClusterSide - 1) / kClusterSide,
              clusters_v = (patches_v + kClusterSide - 1) / kClusterSide;
    clusters_.assign(static_cast<size_t>(clusters_u) * static_cast<size_t>(clusters_v), -1);
    for (int j = 0; j < patches_v; ++j) {
      for (int i = 0; i < patches_u; ++i) {
        cluster_ = static_cast<size_t>(j / kClusterSide) * static_cast<size_t>(clusters_u) +
                   static_cast<size_t>(i / kClusterSide);
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
      if (coverage_.empty()) {
        free.element = MakeElement(facet, PlaceOf(facet, cell, grid.cells_u, grid.cells_v));
      } else {
        Cover(facet, cell, free);
      }
      if (free.covered > 0)
        free.free = FreeShare(scene_, rays_, free.element, facet.kind == FacetKind::kTriangle);
      free.element.is_whole = free.element.is_whole && free.free == 1;
    }
  }

  // Makes the element of a cell that a surface covers in part.
  void Cover(const Facet& facet, const Cell& cell, FreeCell& free) {
    const FacetGrid& grid = result.grids.back();
    const CellCoverage& coverage = coverage_[grid.Index(cell.i, cell.j, false)];
    Place place = PlaceOf(facet, cell, grid.cells_u, grid.cells_v);
    const double filled = coverage.Filled();
    if (filled == 0) {
      free.element = MakeElement(facet, place);
      free.covered = 0;
      return;
    }
    const Eigen::Vector2d low = coverage.box.min() - Eigen::Vector2d(cell.i, cell.j),
                          size = coverage.box.sizes();
    place = {place.origin + low.x() * place.edge_u + low.y() * place.edge_v, size.x() * place.edge_u,
             size.y() * place.edge_v};
    const Eigen::Vector3d center =
        facet.PointAt(coverage.center.x() / grid.cells_u, coverage.center.y() / grid.cells_v);
    const bool is_whole = filled > kFillsElement;
    if (is_whole) {
      place = Shrunk(place, filled);
      place.origin = center - 0.5 * (place.edge_u + place.edge_v);
    }
    free.element = MakeElement(facet, place);
    free.element.center = center;
    free.element.is_whole = is_whole;
    free.covered = is_whole ? 1 : filled;
  }

  // Tells whether a cell's part is so small that the next cell's element takes it in.
  bool IsCrumb(const Cell& cell) const {
    return !coverage_.empty() &&
           coverage_[result.grids.back().Index(cell.i, cell.j, false)].area < kLeastCovered;
  }

  // A patch that a solid stands on would carry light from one of its sides to the other.
  bool MustSplit(const std::vector<Cell>& cells) {
    std::vector<Element> free;
    bool stands_free = true;
    for (const Cell& cell : cells) {
      if (At(cell).covered == 0) continue;
      stands_free = stands_free && At(cell).free == 1;
      if (At(cell).free > 0) free.push_back(At(cell).element);
    }
    if (free.empty()) return false;
    const int facet = static_cast<int>(result.facets.size()) - 1;
    return !stands_free || (options_.must_split && options_.must_split(facet, free));
  }

  void AddPatch(const Place& place, const std::vector<Cell>& cells) {
    Patch patch;
    patch.facet = static_cast<int>(result.facets.size()) - 1;
    patch.material = result.facets.back().material;
    patch.origin = place.origin;
    patch.edge_u = place.edge_u;
    patch.edge_v = place.edge_v;
    patch.first_element = static_cast<int>(result.elements.size());
    for (const bool crumbs : {false, true}) {
      for (const Cell& cell : cells) {
        const FreeCell& free = At(cell);
        patch.is_whole = patch.is_whole && (free.covered == 0 || free.free == 1);
        if (free.Share() > 0 && IsCrumb(cell) == crumbs) AddElement(cell, patch);
      }
    }
    if (patch.element_count == 0) return;
    patch.center.setZero();
    const auto first = result.elements.begin() + patch.first_element;
    for (auto element = first; element != result.elements.end(); ++element) {
      patch.area_m2 += element->area_m2;
      patch.center += element->area_m2 * element->center;
    }
    patch.center /= patch.area_m2;
    if (!coverage_.empty()) Fit(patch);
    if (clusters_[cluster_] < 0) clusters_[cluster_] = cluster_count_++;
    patch.cluster = clusters_[cluster_];
    result.patches.push_back(patch);
  }

  void AddElement(const Cell& cell, Patch& patch) {
    FacetGrid& grid = result.grids.back();
    int& own = grid.element_of_cell[grid.Index(cell.i, cell.j, cell.upper)];
    Element element = At(cell).element;
    element.patch = static_cast<int>(result.patches.size());
    element.area_m2 *= At(cell).Share();
    const int next = IsCrumb(cell) ? NextTo(cell, patch) : -1;
    if (next >= 0) {
      own = next;
      result.elements[static_cast<size_t>(next)].area_m2 += element.area_m2;
      return;
    }
    own = static_cast<int>(result.elements.size());
    ++patch.element_count;
    result.elements.push_back(element);
  }

  // Returns an element of the patch beside or at a corner of the cell; -1: there is none.
  int NextTo(const Cell& cell, const Patch& patch) const {
    const FacetGrid& grid = result.grids.back();
    for (const auto& [di, dj] :
         {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}) {
      const int i = cell.i + di, j = cell.j + dj;
      if (i < 0 || j < 0 || i >= grid.cells_u || j >= grid.cells_v) continue;
      const int element = grid.element_of_cell[grid.Index(i, j, false)];
      if (element >= patch.first_element) return element;
    }
    return -1;
  }

  // Fits the patch's rectangle to what the surface covers of it.
  void Fit(Patch& patch) const {
    const Facet& facet = result.facets.back();
    const Eigen::Vector3d along = facet.edge_u.normalized(), across = facet.edge_v.normalized();
    Eigen::AlignedBox2d box;
    for (auto element = result.elements.begin() + patch.first_element; element != result.elements.end();
         ++element) {
      for (const Eigen::Vector3d& corner :
           {element->origin, Eigen::Vector3d(element->origin + element->edge_u + element->edge_v)})
        box.extend(Eigen::Vector2d(along.dot(corner - facet.origin), across.dot(corner - facet.origin)));
    }
    const double filled = std::min(1.0, patch.area_m2 / box.volume());
    const Place place{facet.origin + box.min().x() * along + box.min().y() * across, box.sizes().x() * along,
                      box.sizes().y() * across};
    const bool is_rectangle = filled > kFillsPatch;
    patch.is_whole = patch.is_whole && is_rectangle;
    const Place fitted = is_rectangle ? Shrunk(place, filled) : place;
    patch.origin = fitted.origin;
    patch.edge_u = fitted.edge_u;
    patch.edge_v = fitted.edge_v;
  }

  const Scene& scene_;
  const RayScene& rays_;
  const PatchesOptions& options_;
  std::vector<int> clusters_;  // numbers of those of the facet at hand; -1: no patch yet
  size_t cluster_ = 0;         // where the one at hand is in them
  int cluster_count_ = 0;
  std::vector<FreeCell> free_cells_;    // those of the facet at hand
  std::vector<CellCoverage> coverage_;  // likewise; empty: all of it is covered
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

PatchCounts CountPatches(const Scene& scene, const PatchesOptions& sizes) {
  const auto count = [](double length_m, double size_m) {
    return std::max(1.0, std::ceil(length_m / size_m));
  };
  PatchCounts counts;
  for (const Facet& facet : scene.facets) {
    double u_m = facet.edge_u.norm(), v_m = facet.edge_v.norm();
    if (facet.kind == FacetKind::kTriangle)
      u_m = v_m = std::max({u_m, v_m, (facet.edge_u - facet.edge_v).norm()});
    const double along_u = count(u_m, sizes.patch_size_m), along_v = count(v_m, sizes.patch_size_m);
    counts.patches += along_u * along_v;
    counts.elements += along_u * count(u_m / along_u, sizes.element_size_m) * along_v *
                       count(v_m / along_v, sizes.element_size_m);
  }
  return counts;
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
