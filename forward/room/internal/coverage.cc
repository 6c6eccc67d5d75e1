#include "forward/room/internal/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace luxfit {
namespace {

using Eigen::Vector2d;

// Holds a convex polygon: a triangle cut by four lines has seven corners at most.
struct Clipped {
  std::array<Vector2d, 8> corners;
  size_t count = 0;
};

// Keeps what lies at `side` (1: above, -1: below) of a value of one coordinate.
Clipped Keep(const Clipped& polygon, int axis, double value, double side) {
  Clipped kept;
  for (size_t i = 0; i < polygon.count; ++i) {
    const Vector2d &a = polygon.corners[i], &b = polygon.corners[(i + 1) % polygon.count];
    const double da = side * (a[axis] - value), db = side * (b[axis] - value);
    if (da >= 0) kept.corners[kept.count++] = a;
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) kept.corners[kept.count++] = a + da / (da - db) * (b - a);
  }
  return kept;
}

void Add(const Clipped& polygon, CellCoverage& cell) {
  const Vector2d& o = polygon.corners[0];
  for (size_t i = 2; i < polygon.count; ++i) {
    const Vector2d a = polygon.corners[i - 1] - o, b = polygon.corners[i] - o;
    const double area = 0.5 * (a.x() * b.y() - a.y() * b.x());
    cell.area += area;
    cell.center += area * (o + (a + b) / 3);
  }
  for (size_t i = 0; i < polygon.count; ++i) cell.box.extend(polygon.corners[i]);
}

}  // namespace

std::vector<CellCoverage> CoverageOf(const std::vector<SurfaceTriangle>& triangles, int cells_u,
                                     int cells_v) {
  std::vector<CellCoverage> cells(static_cast<size_t>(cells_u) * static_cast<size_t>(cells_v));
  const Vector2d scale(cells_u, cells_v);
  for (const SurfaceTriangle& triangle : triangles) {
    Clipped whole;
    Eigen::AlignedBox2d box;
    for (const Vector2d& corner : triangle.corners) {
      whole.corners[whole.count++] = corner.cwiseProduct(scale);
      box.extend(corner.cwiseProduct(scale));
    }
    const auto first = [](double low) { return std::max(0, static_cast<int>(std::floor(low))); };
    const auto last = [](double high, int count) {
      return std::min(count - 1, static_cast<int>(std::floor(high)));
    };
    for (int j = first(box.min().y()); j <= last(box.max().y(), cells_v); ++j) {
      const Clipped row = Keep(Keep(whole, 1, j, 1), 1, j + 1, -1);
      for (int i = first(box.min().x()); i <= last(box.max().x(), cells_u) && row.count > 2; ++i) {
        const Clipped part = Keep(Keep(row, 0, i, 1), 0, i + 1, -1);
        if (part.count > 2)
          Add(part, cells[static_cast<size_t>(j) * static_cast<size_t>(cells_u) + static_cast<size_t>(i)]);
      }
    }
  }
  for (CellCoverage& cell : cells) {
    if (cell.area > 0) cell.center /= cell.area;
    cell.area = std::min(cell.area, 1.0);
  }
  return cells;
}

}  // namespace luxfit
