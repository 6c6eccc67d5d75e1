#include "apps/session/photos/internal/tag_bias.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace luxfit {
namespace {

constexpr int kTag = 7;
constexpr int kStates = 4;

// Two views of four states that show one tag. The second sees it brighter by `bias` in every state.
std::vector<LightGroup> TwoViewsOfATag(double bias) {
  const double light[kStates] = {0.1, 1.2, -0.7, 2.0};
  std::vector<LightGroup> groups;
  for (int view = 0; view < 2; ++view) {
    for (const double value : light) {
      LightGroup group;
      group.view = view;
      group.log_light[kTag] = value + view * bias;
      groups.push_back(group);
    }
  }
  return groups;
}

double WorstDifference(const std::vector<LightGroup>& groups) {
  double worst = 0;
  for (size_t i = 0; i < kStates; ++i)
    worst = std::max(worst, TagLightDifference(groups[i], groups[i + kStates]).value_or(9));
  return worst;
}

// n = 4: the first view is moved by 4/5 of the bias, then the second by 4/5 of what is left.
TEST(TagBiasTest, WhatAllStatesShareIsTakenOut) {
  const std::vector<LightGroup> groups = WithoutTagBias(TwoViewsOfATag(0.2), {0, 1, 2, 3, 0, 1, 2, 3});
  EXPECT_NEAR(WorstDifference(groups), 0.2 / 25, 1e-12);
}

TEST(TagBiasTest, TwoStatesThatAreSwappedStayTold) {
  const std::vector<LightGroup> groups = WithoutTagBias(TwoViewsOfATag(0), {0, 1, 2, 3, 0, 1, 3, 2});
  EXPECT_NEAR(WorstDifference(groups), 0, 1e-12);
}

TEST(TagBiasTest, LargeDifferencesAreNoBias) {
  const std::vector<LightGroup> groups = WithoutTagBias(TwoViewsOfATag(2), {0, 1, 2, 3, 0, 1, 2, 3});
  EXPECT_NEAR(WorstDifference(groups), 1.5, 1e-12);
}

TEST(TagBiasTest, TwoStatesAreTooFew) {
  const std::vector<LightGroup> groups = WithoutTagBias(TwoViewsOfATag(0.2), {0, 1, 4, 5, 0, 1, 6, 7});
  EXPECT_NEAR(WorstDifference(groups), 0.2, 1e-12);
}

}  // namespace
}  // namespace luxfit
