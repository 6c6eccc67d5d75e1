#include "inverse/albedo/internal/even_patches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace luxfit {
namespace {

// Returns the node of all values that are named.
RegionNode NodeOf(const std::vector<ValueInPatch>& values, const std::vector<size_t>& which, double sigma) {
  RegionNode node;
  const auto count = static_cast<double>(which.size());
  for (const size_t i : which) {
    node.value += values[i].value / count;
    node.area_m2 += values[i].area_m2;
  }
  node.variance = sigma * sigma / count;
  return node;
}

bool IsEven(const std::vector<ValueInPatch>& values, const std::vector<size_t>& which, double mean,
            double variance) {
  const auto count = static_cast<double>(which.size());
  double scatter = 0;
  for (const size_t i : which) scatter += std::pow(values[i].value - mean, 2) / count;
  return scatter <= variance * (1 + 3 * std::sqrt(2 / count));
}

}  // namespace

RegionGraph GraphOfEvenPatches(const std::vector<ValueInPatch>& values,
                               const std::vector<std::pair<int, int>>& pairs, double sigma,
                               double shared_sigma) {
  RegionGraph graph;
  graph.of_value.resize(values.size());
  std::map<int, std::vector<size_t>> of_patch;
  for (size_t i = 0; i < values.size(); ++i) of_patch[values[i].patch].push_back(i);
  const auto add = [&](const RegionNode& node, const std::vector<size_t>& which) {
    for (const size_t i : which) graph.of_value[i] = static_cast<int>(graph.nodes.size());
    graph.nodes.push_back(node);
  };
  for (const auto& [patch, own] : of_patch) {
    const RegionNode whole = NodeOf(values, own, sigma);
    if (IsEven(values, own, whole.value, sigma * sigma + shared_sigma * shared_sigma)) {
      add(whole, own);
      continue;
    }
    for (const size_t i : own) add(NodeOf(values, {i}, sigma), {i});
  }
  for (const auto& [a, b] : pairs) {
    const int x = graph.of_value[static_cast<size_t>(a)], y = graph.of_value[static_cast<size_t>(b)];
    if (x != y) graph.edges.emplace_back(std::min(x, y), std::max(x, y));
  }
  std::sort(graph.edges.begin(), graph.edges.end());
  graph.edges.erase(std::unique(graph.edges.begin(), graph.edges.end()), graph.edges.end());
  return graph;
}

}  // namespace luxfit
