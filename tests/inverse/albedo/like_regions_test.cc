#include "inverse/albedo/internal/like_regions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace luxfit {
namespace {

using Edges = std::vector<std::pair<int, int>>;

// Returns nodes of 0.2 m2 and sigma 0.01, and the chain that joins them.
std::vector<RegionNode> Chain(const std::vector<double>& values, Edges& edges) {
  std::vector<RegionNode> nodes;
  for (const double value : values) {
    if (!nodes.empty())
      edges.emplace_back(static_cast<int>(nodes.size()) - 1, static_cast<int>(nodes.size()));
    nodes.push_back({value, 1e-4, 0.2});
  }
  return nodes;
}

TEST(LikeRegions, AStepCutsAChainAndZIsThatOfTheMeans) {
  Edges edges;
  const std::vector<RegionNode> nodes = Chain({0, 0, 0, 0, 0.1, 0.1}, edges);
  LikeRegionsOptions options;
  options.shared_sigma = 0.02;
  const LikeRegions regions = GrowLikeRegions(nodes, edges, options);
  EXPECT_EQ(regions.of_node, (std::vector<int>{0, 0, 0, 0, 1, 1}));
  EXPECT_NEAR(regions.least_z, 0.1 / std::sqrt(1e-4 / 4 + 1e-4 / 2 + 2 * 4e-4), 1e-9);
}

// The same step is none where the light errs by 5 % from region to region: z = 0.1 / (0.05 sqrt(2)) = 1.4.
TEST(LikeRegions, AStepWithinTheSharedErrorIsNone) {
  Edges edges;
  const std::vector<RegionNode> nodes = Chain({0, 0, 0, 0, 0.1, 0.1}, edges);
  LikeRegionsOptions options;
  options.shared_sigma = 0.05;
  EXPECT_EQ(GrowLikeRegions(nodes, edges, options).count, 1);
}

TEST(LikeRegions, WhatDoesNotAdjoinStaysApart) {
  EXPECT_EQ(GrowLikeRegions({{0, 1e-4, 1}, {0, 1e-4, 1}}, {}).count, 2);
}

TEST(LikeRegions, AStainJoinsTheNeighbourThatIsMostLikeItAndHasNoSay) {
  Edges edges;
  std::vector<RegionNode> nodes = Chain({0, 0, 0.4, 1, 1}, edges);
  nodes[2].area_m2 = 0.05;
  const LikeRegions regions = GrowLikeRegions(nodes, edges);
  EXPECT_EQ(regions.of_node, (std::vector<int>{0, 0, 0, 1, 1}));
  EXPECT_EQ(regions.has_say, (std::vector<bool>{true, true, false, true, true}));
}

TEST(LikeRegions, RefusesWhatIsNoGraph) {
  EXPECT_THROW(GrowLikeRegions({{0, 1e-4, 1}}, {{0, 1}}), std::invalid_argument);
  EXPECT_THROW(GrowLikeRegions({{0, 0, 1}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
