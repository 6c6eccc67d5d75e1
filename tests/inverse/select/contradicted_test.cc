#include "inverse/select/contradicted.h"

#include <gtest/gtest.h>

#include <vector>

namespace luxfit {
namespace {

// One group a score, of four rows each.
GroupScores Scores(const std::vector<double>& means) {
  GroupScores scores;
  for (size_t g = 0; g < means.size(); ++g) scores[static_cast<int>(g)] = {4 * means[g], 4};
  return scores;
}

TEST(Contradicted, ByARivalThatHalvesTheScoreEverywhere) {
  EXPECT_TRUE(IsContradicted(Scores({4, 5, 4, 5, 4}), Scores({1, 2, 1, 2, 1})));
  EXPECT_FALSE(IsContradicted(Scores({1, 2, 1, 2, 1}), Scores({4, 5, 4, 5, 4})));
}

TEST(Contradicted, NotByAGainOfLessThanHalf) {
  EXPECT_FALSE(IsContradicted(Scores({4, 5, 4, 5, 4}), Scores({2.5, 3.5, 2.5, 3.5, 2.5})));
}

TEST(Contradicted, NotByOneGroupAlone) {
  EXPECT_FALSE(IsContradicted(Scores({9, 1, 1, 1, 1}), Scores({1, 1, 1, 1, 1})));
}

TEST(Contradicted, NotByThreeGroups) { EXPECT_FALSE(IsContradicted(Scores({9, 9, 9}), Scores({1, 1, 1}))); }

}  // namespace
}  // namespace luxfit
