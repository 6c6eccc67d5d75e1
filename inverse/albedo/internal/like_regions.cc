#include "inverse/albedo/internal/like_regions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <tuple>

namespace luxfit {
namespace {

using Edge = std::pair<int, int>;
using RatedEdge = std::tuple<double, int, int>;  // z^2, then the nodes

// Holds regions as a forest of nodes. Each root has the sums of its region.
class RegionForest {
 public:
  RegionForest(const std::vector<RegionNode>& nodes, const LikeRegionsOptions& options)
      : options_(options), parent_(nodes.size()), has_say_(nodes.size(), true) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (const RegionNode& node : nodes)
      sums_.push_back({1 / node.variance, node.value / node.variance, node.area_m2});
  }

  int RootOf(int node) {
    while (ParentOf(node) != node) {
      ParentOf(node) = ParentOf(ParentOf(node));
      node = ParentOf(node);
    }
    return node;
  }

  // Returns z^2 of two roots.
  double ZSquared(int a, int b) const {
    const Sums &x = Of(a), &y = Of(b);
    const double difference = x.values / x.weight - y.values / y.weight;
    return difference * difference /
           (1 / x.weight + 1 / y.weight + 2 * options_.shared_sigma * options_.shared_sigma);
  }

  void Merge(int a, int b) {
    Of(a).weight += Of(b).weight;
    Of(a).values += Of(b).values;
    Of(a).area_m2 += Of(b).area_m2;
    ParentOf(b) = a;
  }

  void TakeIn(int large, int small) {
    for (int node = 0; node < static_cast<int>(parent_.size()); ++node) {
      if (RootOf(node) == small) has_say_[static_cast<size_t>(node)] = false;
    }
    Of(large).area_m2 += Of(small).area_m2;
    ParentOf(small) = large;
  }

  bool IsSmall(int root) const { return Of(root).area_m2 < options_.least_m2; }
  double AreaM2(int root) const { return Of(root).area_m2; }
  const std::vector<bool>& has_say() const { return has_say_; }

 private:
  struct Sums {
    double weight = 0, values = 0, area_m2 = 0;
  };
  int& ParentOf(int node) { return parent_[static_cast<size_t>(node)]; }
  Sums& Of(int root) { return sums_[static_cast<size_t>(root)]; }
  const Sums& Of(int root) const { return sums_[static_cast<size_t>(root)]; }

  const LikeRegionsOptions& options_;
  std::vector<int> parent_;
  std::vector<bool> has_say_;
  std::vector<Sums> sums_;
};

// Merges what is alike, the most alike first. A pair whose regions have changed is rated anew as its turn comes.
// Returns whether anything was merged.
bool MergeAlike(const std::vector<Edge>& edges, double most_z2, RegionForest& forest) {
  std::priority_queue<RatedEdge, std::vector<RatedEdge>, std::greater<>> queue;
  const auto rate = [&](int a, int b) {
    if (a == b) return;
    const double z2 = forest.ZSquared(a, b);
    if (z2 < most_z2) queue.emplace(z2, std::min(a, b), std::max(a, b));
  };
  for (const auto& [a, b] : edges) rate(forest.RootOf(a), forest.RootOf(b));
  bool has_merged = false;
  while (!queue.empty()) {
    const auto [z2, a, b] = queue.top();
    queue.pop();
    const int x = forest.RootOf(a), y = forest.RootOf(b);
    if (x == y) continue;
    if (forest.ZSquared(x, y) > z2) {
      rate(x, y);
      continue;
    }
    forest.Merge(std::min(x, y), std::max(x, y));
    has_merged = true;
  }
  return has_merged;
}

// Gives small regions to the neighbours that are most like them, the smallest first. Returns whether any was given.
bool TakeInSmall(const std::vector<Edge>& edges, RegionForest& forest) {
  std::map<int, std::pair<double, int>> nearest;  // by small region: z^2 and the neighbour
  const auto offer = [&](int small, int other) {
    if (!forest.IsSmall(small)) return;
    const std::pair<double, int> rated{forest.ZSquared(small, other), other};
    const auto [at, is_new] = nearest.try_emplace(small, rated);
    if (!is_new) at->second = std::min(at->second, rated);
  };
  for (const auto& [a, b] : edges) {
    const int x = forest.RootOf(a), y = forest.RootOf(b);
    if (x == y) continue;
    offer(x, y);
    offer(y, x);
  }
  std::vector<std::pair<double, int>> by_area;
  by_area.reserve(nearest.size());
  for (const auto& [small, other] : nearest) by_area.emplace_back(forest.AreaM2(small), small);
  std::sort(by_area.begin(), by_area.end());
  for (const auto& [area_m2, small] : by_area) {
    const int other = forest.RootOf(nearest[small].second);
    const bool is_done = forest.RootOf(small) != small || !forest.IsSmall(small);  // by one before it
    if (is_done || other == small) continue;
    const bool is_larger = forest.AreaM2(other) >= forest.AreaM2(small);
    forest.TakeIn(is_larger ? other : small, is_larger ? small : other);
  }
  return !by_area.empty();
}

LikeRegions Numbered(const std::vector<Edge>& edges, int nodes, RegionForest& forest) {
  LikeRegions regions;
  regions.has_say = forest.has_say();
  std::map<int, int> number;
  for (int node = 0; node < nodes; ++node) {
    const auto [at, is_new] = number.try_emplace(forest.RootOf(node), regions.count);
    if (is_new) ++regions.count;
    regions.of_node.push_back(at->second);
  }
  for (const auto& [a, b] : edges) {
    const int x = forest.RootOf(a), y = forest.RootOf(b);
    if (x != y) regions.least_z = std::min(regions.least_z, std::sqrt(forest.ZSquared(x, y)));
  }
  return regions;
}

}  // namespace

LikeRegions GrowLikeRegions(const std::vector<RegionNode>& nodes, const std::vector<Edge>& edges,
                            const LikeRegionsOptions& options) {
  const int count = static_cast<int>(nodes.size());
  for (const RegionNode& node : nodes) {
    if (!(node.variance > 0))
      throw std::invalid_argument("GrowLikeRegions: expected a positive variance of each node");
  }
  for (const auto& [a, b] : edges) {
    if (std::min(a, b) < 0 || std::max(a, b) >= count)
      throw std::invalid_argument("GrowLikeRegions: expected edges between nodes");
  }
  RegionForest forest(nodes, options);
  const double most_z2 = options.most_sigmas * options.most_sigmas;
  // Each round leaves fewer regions, so this ends.
  for (bool is_under_way = true; is_under_way;) {
    while (MergeAlike(edges, most_z2, forest)) {
    }
    is_under_way = TakeInSmall(edges, forest);
  }
  return Numbered(edges, count, forest);
}

}  // namespace luxfit
