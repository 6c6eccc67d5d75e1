#include "inverse/furniture/painted_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "calib/luminance/median.h"
#include "forward/room/visibility.h"
#include "inverse/furniture/internal/facet_picture.h"
#include "inverse/furniture/internal/hull_planes.h"

namespace luxfit {
namespace {

constexpr double kSmoothStep = 0.12;  // of ln Y from a cell to the next: no light but a hard shadow's edge
constexpr double kLeastStep = 0.3;
constexpr double kLeastPartM2 = 0.1, kLeastFacetM2 = 1, kLeastFill = 0.8;
constexpr double kMostOfFacet = 0.6;
constexpr int kFewestAtSide = 5;  // pairs of cells
constexpr int kInside = 2, kOutside = 2,
              kReach = 4;  // cells from a side that blur does not reach, and those looked at

// Holds the cells first .. last - 1 along each way.
struct CellBox {
  std::array<int, 2> first{}, last{};  // column, row
  std::vector<size_t> cells;           // of the part
  int Extent(int axis) const { return last[static_cast<size_t>(axis)] - first[static_cast<size_t>(axis)]; }
};

// Returns the boxes about cells that are joined by smooth steps.
std::vector<CellBox> JoinedCells(const FacetPicture& picture) {
  std::vector<char> is_taken(static_cast<size_t>(picture.rows) * static_cast<size_t>(picture.columns), 0);
  std::vector<CellBox> boxes;
  std::vector<std::array<int, 2>> open;
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.columns; ++column) {
      if (is_taken[picture.At(row, column)]) continue;
      CellBox box{{column, row}, {column + 1, row + 1}, {}};
      open.assign(1, {column, row});
      is_taken[picture.At(row, column)] = 1;
      while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        box.cells.push_back(picture.At(y, x));
        box.first = {std::min(box.first[0], x), std::min(box.first[1], y)};
        box.last = {std::max(box.last[0], x + 1), std::max(box.last[1], y + 1)};
        for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
          const int nx = x + dx, ny = y + dy;
          if (nx < 0 || ny < 0 || nx >= picture.columns || ny >= picture.rows) continue;
          const size_t next = picture.At(ny, nx);
          if (is_taken[next] || !(std::abs(picture.Step(picture.At(y, x), next)) < kSmoothStep)) continue;
          is_taken[next] = 1;
          open.push_back({nx, ny});
        }
      }
      boxes.push_back(std::move(box));
    }
  }
  return boxes;
}

// One side of a box: cells are counted outwards from it, 0 is the first outside.
class Side {
 public:
  Side(const FacetPicture& picture, const CellBox& box, int axis, bool is_far)
      : picture_(picture), box_(box), axis_(static_cast<size_t>(axis)), is_far_(is_far) {}

  // Returns the median step from the cells `from` to the cells `to` along the side; NaN where too few are known.
  double Step(int from, int to) const {
    std::vector<double> steps;
    const size_t along = 1 - axis_;
    for (int i = box_.first[along]; i < box_.last[along]; ++i) {
      const auto a = CellAt(from, i), b = CellAt(to, i);
      if (!a || !b) continue;
      const double step = picture_.Step(*a, *b);
      if (std::isfinite(step)) steps.push_back(step);
    }
    return steps.size() < static_cast<size_t>(kFewestAtSide) ? std::numeric_limits<double>::quiet_NaN()
                                                             : Median(std::move(steps));
  }

  // Returns where the luminance passes the middle between inside and outside, in cells outwards from the box; 0 where none is known.
  double Place() const {
    std::array<double, size_t{2} * kReach>
        luminance{};  // over that inside, of the cells -kReach .. kReach - 1
    int outwards = -kReach;
    for (double& at : luminance) at = std::exp(Step(-kReach, outwards++));
    const double middle = (1 + luminance.back()) / 2;
    for (size_t k = 1; k < luminance.size(); ++k) {
      const double before = luminance[k - 1] - middle, after = luminance[k] - middle;
      if (before * after <= 0 && before != after)
        return static_cast<double>(k) - kReach - 0.5 + before / (before - after);
    }
    return 0;
  }

 private:
  std::optional<size_t> CellAt(int outwards, int along) const {
    const int at = is_far_ ? box_.last[axis_] + outwards : box_.first[axis_] - 1 - outwards;
    const int most = axis_ == 0 ? picture_.columns : picture_.rows;
    if (at < 0 || at >= most) return {};
    return axis_ == 0 ? picture_.At(along, at) : picture_.At(at, along);
  }

  const FacetPicture& picture_;
  const CellBox& box_;
  size_t axis_;
  bool is_far_;
};

// Returns the part of the facet whose cells the box holds, where it is one.
std::optional<PaintedPart> PartIn(const Facet& facet, const FacetPicture& picture, const CellBox& box) {
  const double cell_m2 = picture.width_m * picture.height_m;
  const int cells = box.Extent(0) * box.Extent(1);
  if (cells * cell_m2 < kLeastPartM2 || static_cast<double>(box.cells.size()) < kLeastFill * cells ||
      cells > kMostOfFacet * picture.columns * picture.rows)
    return {};
  PaintedPart part;
  std::array<double, 2> low{}, high{};
  double sum = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const auto a = static_cast<size_t>(axis);
    low[a] = box.first[a];
    high[a] = box.last[a];
    for (const bool is_far : {false, true}) {
      const Side side(picture, box, axis, is_far);
      const double step = side.Step(-1 - kInside, kOutside);
      if (!std::isfinite(step)) continue;
      if (std::abs(step) < kLeastStep || step * sum < 0) return {};
      sum += step;
      ++part.sides;
      (is_far ? high[a] : low[a]) += is_far ? side.Place() : -side.Place();
    }
  }
  if (part.sides < 2) return {};
  // Views that show the wall at a cell of a part, or the other way round, are a whole step apart.
  const double step = sum / part.sides;
  const auto agreed = std::count_if(box.cells.begin(), box.cells.end(),
                                    [&](size_t cell) { return picture.apart[cell] < std::abs(step) / 2; });
  if (static_cast<double>(agreed) < kLeastFill * cells) return {};
  part.luminance_ratio = std::exp(-step);
  const Eigen::Vector3d u = facet.edge_u / picture.columns, v = facet.edge_v / picture.rows;
  part.rectangle.corner = facet.origin + low[0] * u + low[1] * v;
  part.rectangle.edge_u = (high[0] - low[0]) * u;
  part.rectangle.edge_v = (high[1] - low[1]) * v;
  return part;
}

bool IsUprightRectangle(const Facet& facet) {
  constexpr double kLevel = 1e-3;
  return facet.kind == FacetKind::kParallelogram && facet.AreaM2() >= kLeastFacetM2 &&
         std::abs(facet.Normal().z()) < kLevel &&
         std::abs(facet.edge_u.dot(facet.edge_v)) < kLevel * facet.edge_u.norm() * facet.edge_v.norm();
}

double AreaOf(const PaintedPart& part) { return part.rectangle.edge_u.norm() * part.rectangle.edge_v.norm(); }

}  // namespace

std::vector<PaintedPart> FindPaintedParts(const Scene& room, const std::vector<SignatureView>& views) {
  if (!room.surface.empty() || views.size() < 2) return {};
  const RayScene rays(room);
  std::vector<PaintedPart> parts;
  for (const HullPlane& plane : FindHullPlanes(room, rays)) {
    for (const int f : plane.facets) {
      const Facet& facet = room.facets[static_cast<size_t>(f)];
      if (!IsUprightRectangle(facet)) continue;
      const FacetPicture picture = PictureOf(facet, rays, views);
      for (const CellBox& box : JoinedCells(picture)) {
        std::optional<PaintedPart> part = PartIn(facet, picture, box);
        if (!part) continue;
        part->material = room.materials[static_cast<size_t>(facet.material)];
        parts.push_back(std::move(*part));
      }
    }
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const PaintedPart& a, const PaintedPart& b) { return AreaOf(a) > AreaOf(b); });
  for (size_t i = 0; i < parts.size(); ++i) parts[i].rectangle.name = "part " + std::to_string(i + 1);
  return parts;
}

}  // namespace luxfit
