#include "inverse/control/pixel_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace luxfit {
namespace {

// Joins numbers into sets (union by the smaller root, paths halved).
class DisjointSets {
 public:
  explicit DisjointSets(size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), size_t{0});
  }

  size_t Root(size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(size_t a, size_t b) {
    a = Root(a);
    b = Root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<size_t> parent_;
};

void JoinNeighbours(const PixelMask& mask, DisjointSets& sets) {
  const Eigen::Index width = mask.cols();
  for (Eigen::Index v = 0; v < mask.rows(); ++v) {
    for (Eigen::Index u = 0; u < width; ++u) {
      if (!mask(v, u)) continue;
      const auto i = static_cast<size_t>(v * width + u);
      if (u > 0 && mask(v, u - 1)) sets.Join(i, i - 1);
      if (v > 0 && mask(v - 1, u)) sets.Join(i, i - static_cast<size_t>(width));
    }
  }
}

bool IsOnBorder(const PixelMask& mask, Eigen::Index v, Eigen::Index u) {
  const bool is_inside = v > 0 && u > 0 && v + 1 < mask.rows() && u + 1 < mask.cols();
  return !is_inside || !mask(v - 1, u) || !mask(v + 1, u) || !mask(v, u - 1) || !mask(v, u + 1);
}

// Cells of a cubic grid, with the border pixels whose directions end in them.
using GridCell = std::array<int, 3>;
using GridCells = std::map<GridCell, std::vector<size_t>>;

GridCells CellsOfBorder(const PixelMask& mask, const PixelDirections& directions, double side) {
  GridCells cells;
  for (Eigen::Index v = 0; v < mask.rows(); ++v) {
    for (Eigen::Index u = 0; u < mask.cols(); ++u) {
      if (!mask(v, u) || !IsOnBorder(mask, v, u)) continue;
      const Eigen::Index i = v * mask.cols() + u;
      const Eigen::Array3i at = (directions.col(i).array().cast<double>() / side).floor().cast<int>();
      cells[{at[0], at[1], at[2]}].push_back(static_cast<size_t>(i));
    }
  }
  return cells;
}

bool ComeNear(const std::vector<size_t>& a, const std::vector<size_t>& b, const PixelDirections& directions,
              double chord) {
  for (const size_t i : a) {
    for (const size_t j : b) {
      const float distance =
          (directions.col(static_cast<Eigen::Index>(i)) - directions.col(static_cast<Eigen::Index>(j)))
              .norm();
      if (distance <= chord) return true;
    }
  }
  return false;
}

// All pixels of one cell are near each other, because its diagonal is the chord of the angle. Cells that may be near are
// two apart at most.
void JoinNear(const PixelMask& mask, const PixelDirections& directions, double angle_rad,
              DisjointSets& sets) {
  const double chord = 2 * std::sin(angle_rad / 2);
  const GridCells cells = CellsOfBorder(mask, directions, chord / std::sqrt(3.0));
  for (const auto& [cell, pixels] : cells) {
    for (const size_t i : pixels) sets.Join(i, pixels.front());
    for (int step = 0; step < 125; ++step) {
      const GridCell other{cell[0] + step % 5 - 2, cell[1] + step / 5 % 5 - 2, cell[2] + step / 25 - 2};
      const auto near = cells.find(other);
      if (near == cells.end() || !(cell < other)) continue;
      if (sets.Root(pixels.front()) == sets.Root(near->second.front())) continue;
      if (ComeNear(pixels, near->second, directions, chord)) sets.Join(pixels.front(), near->second.front());
    }
  }
}

}  // namespace

PixelGroups GroupPixels(const PixelMask& mask, const PixelDirections& directions, double angle_rad) {
  if (directions.cols() != mask.size())
    throw std::invalid_argument("GroupPixels: expected a direction for each pixel");
  if (!(angle_rad > 0)) throw std::invalid_argument("GroupPixels: angle_rad: expected > 0");
  DisjointSets sets(static_cast<size_t>(mask.size()));
  JoinNeighbours(mask, sets);
  JoinNear(mask, directions, angle_rad, sets);
  PixelGroups groups;
  groups.group.setConstant(mask.rows(), mask.cols(), -1);
  std::map<size_t, int> number;
  for (Eigen::Index i = 0; i < mask.size(); ++i) {
    if (!mask.data()[i]) continue;
    groups.group.data()[i] = number.emplace(sets.Root(static_cast<size_t>(i)), groups.count).first->second;
    groups.count = static_cast<int>(number.size());
  }
  return groups;
}

}  // namespace luxfit
