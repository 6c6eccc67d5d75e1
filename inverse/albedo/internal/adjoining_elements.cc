#include "inverse/albedo/internal/adjoining_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace luxfit {
namespace {

using SpaceCell = std::array<int, 3>;

double ReachOf(const Element& element) {
  constexpr double kReach = 1.1;
  return kReach * std::max(element.edge_u.norm(), element.edge_v.norm());
}

// Finds elements near a place by cells as large as the farthest two of them reach.
class NearElements {
 public:
  NearElements(const Patches& patches, const std::vector<int>& elements) {
    for (const int e : elements) all_.push_back(&patches.elements[static_cast<size_t>(e)]);
    for (const Element* element : all_) cell_m_ = std::max(cell_m_, 2 * ReachOf(*element));
    for (size_t i = 0; i < all_.size(); ++i) cells_[CellOf(i)].push_back(static_cast<int>(i));
  }

  std::vector<std::pair<int, int>> Pairs() const {
    std::vector<std::pair<int, int>> pairs;
    for (size_t i = 0; i < all_.size(); ++i) {
      const SpaceCell own = CellOf(i);
      for (int neighbour = 0; neighbour < 27; ++neighbour) {
        const auto at = cells_.find(
            {own[0] + neighbour % 3 - 1, own[1] + neighbour / 3 % 3 - 1, own[2] + neighbour / 9 - 1});
        if (at == cells_.end()) continue;
        for (const int j : at->second) {
          if (static_cast<size_t>(j) > i && Adjoin(*all_[i], *all_[static_cast<size_t>(j)]))
            pairs.emplace_back(static_cast<int>(i), j);
        }
      }
    }
    return pairs;
  }

 private:
  SpaceCell CellOf(size_t i) const {
    const Eigen::Vector3d cell = (all_[i]->center / cell_m_).array().floor();
    return {static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z())};
  }

  static bool Adjoin(const Element& a, const Element& b) {
    constexpr double kOpposite = -0.5;
    return (a.center - b.center).norm() <= ReachOf(a) + ReachOf(b) && a.normal.dot(b.normal) > kOpposite;
  }

  std::vector<const Element*> all_;
  double cell_m_ = 1e-6;
  std::map<SpaceCell, std::vector<int>> cells_;
};

// Appends a pair for each part of a facet after its first.
void JoinPartsOfFacets(const Patches& patches, const std::vector<int>& elements,
                       std::vector<std::pair<int, int>>& pairs) {
  const auto facet_of = [&](int i) { return patches.PatchOf(elements[static_cast<size_t>(i)]).facet; };
  std::vector<int> part(elements.size());
  std::iota(part.begin(), part.end(), 0);
  const auto first_of = [&](int i) {
    while (part[static_cast<size_t>(i)] != i) i = part[static_cast<size_t>(i)];
    return i;
  };
  for (const auto& [a, b] : pairs) {
    if (facet_of(a) != facet_of(b)) continue;
    const int x = first_of(a), y = first_of(b);
    part[static_cast<size_t>(std::max(x, y))] = std::min(x, y);
    part[static_cast<size_t>(b)] = part[static_cast<size_t>(a)] = std::min(x, y);
  }
  std::map<int, int> last_part;  // by facet
  for (int i = 0; i < static_cast<int>(elements.size()); ++i) {
    if (first_of(i) != i) continue;
    const auto [at, is_new] = last_part.try_emplace(facet_of(i), i);
    if (is_new) continue;
    pairs.emplace_back(at->second, i);
    at->second = i;
  }
}

}  // namespace

std::vector<std::pair<int, int>> AdjoiningElements(const Patches& patches, const std::vector<int>& elements) {
  std::vector<std::pair<int, int>> pairs = NearElements(patches, elements).Pairs();
  JoinPartsOfFacets(patches, elements, pairs);
  return pairs;
}

}  // namespace luxfit
