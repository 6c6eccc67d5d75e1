#include "inverse/observe/internal/adjacent_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace luxfit {
namespace {

constexpr double kReach = 1.25;

double EdgeOf(const Element& element) { return std::max(element.edge_u.norm(), element.edge_v.norm()); }

using Cell = std::array<int, 3>;

Cell CellOf(const Eigen::Vector3d& point, double size_m) {
  const Eigen::Vector3d at = (point / size_m).array().floor();
  return {static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z())};
}

// Adds to both columns of each pair those of one view.
void Join(const ViewTable& table, int e, int f, std::vector<std::vector<int>>& neighbours) {
  int b = table.first[static_cast<size_t>(f)];
  const int end_b = table.first[static_cast<size_t>(f) + 1];
  for (int a = table.first[static_cast<size_t>(e)]; a < table.first[static_cast<size_t>(e) + 1]; ++a) {
    const int view = table.view[static_cast<size_t>(a)];
    while (b < end_b && table.view[static_cast<size_t>(b)] < view) ++b;
    if (b == end_b || table.view[static_cast<size_t>(b)] != view) continue;
    neighbours[static_cast<size_t>(a)].push_back(b);
    neighbours[static_cast<size_t>(b)].push_back(a);
  }
}

}  // namespace

std::vector<std::pair<int, int>> AdjacentElements(const Room& room, const std::vector<int>& elements) {
  const auto element = [&](int i) -> const Element& {
    return room.patches.elements[static_cast<size_t>(elements[static_cast<size_t>(i)])];
  };
  const int count = static_cast<int>(elements.size());
  double largest_m = 0;
  for (int i = 0; i < count; ++i) largest_m = std::max(largest_m, EdgeOf(element(i)));
  std::vector<std::pair<int, int>> pairs;
  if (!(largest_m > 0)) return pairs;
  const double size_m = kReach * largest_m;
  std::map<Cell, std::vector<int>> cells;  // of the elements so far
  for (int i = 0; i < count; ++i) {
    const Cell own = CellOf(element(i).center, size_m);
    for (int n = 0; n < 27; ++n) {
      const auto found = cells.find({own[0] + n % 3 - 1, own[1] + n / 3 % 3 - 1, own[2] + n / 9 - 1});
      if (found == cells.end()) continue;
      for (const int j : found->second) {
        const double reach_m = kReach * std::max(EdgeOf(element(i)), EdgeOf(element(j)));
        if ((element(i).center - element(j).center).norm() <= reach_m) pairs.emplace_back(j, i);
      }
    }
    cells[own].push_back(i);
  }
  return pairs;
}

std::vector<std::vector<int>> AdjacentColumns(const Room& room, const ViewTable& table) {
  std::vector<int> elements;
  elements.reserve(static_cast<size_t>(table.elements()));
  for (int e = 0; e < table.elements(); ++e)
    elements.push_back(table.element[static_cast<size_t>(table.first[static_cast<size_t>(e)])]);
  std::vector<std::vector<int>> neighbours(static_cast<size_t>(table.columns()));
  for (const auto& [e, f] : AdjacentElements(room, elements)) Join(table, e, f, neighbours);
  return neighbours;
}

}  // namespace luxfit
