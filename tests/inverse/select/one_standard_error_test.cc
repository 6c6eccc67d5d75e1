#include "inverse/select/one_standard_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "inverse/select/internal/detail_choice.h"

namespace luxfit {
namespace {

// Six groups of ten rows: the mean score, and by how much every other group lies above and below it.
GroupScores Scores(double mean, double spread) {
  GroupScores scores;
  for (int g = 0; g < 6; ++g) scores[g] = {10 * (mean + (g % 2 == 0 ? spread : -spread)), 10};
  return scores;
}

// Paired: what both share cancels, and the error is that of the mean over groups with Student's variance.
TEST(GroupScores, DifferencesArePaired) {
  const PairedDifference difference = Difference(Scores(2, 0.5), Scores(1, 0.2));
  EXPECT_NEAR(difference.mean, 1, 1e-12);
  const double variance_of_mean = 0.3 * 0.3 * 6 / 5 / 6;
  EXPECT_NEAR(difference.standard_error, std::sqrt(variance_of_mean * 5 / 3), 1e-12);
  EXPECT_EQ(Difference(Scores(2, 0.5), Scores(1, 0.5)).standard_error, 0);
}

TEST(GroupScores, ThreeGroupsTellNothing) {
  const GroupScores few{{0, {1, 1}}, {1, {2, 1}}, {2, {3, 1}}};
  EXPECT_TRUE(std::isinf(Difference(few, few).standard_error));
}

TEST(OneStandardError, TheSimplestWithinTheErrorIsChosen) {
  const double error = Difference(Scores(1, 0.3), Scores(1, 0)).standard_error;
  const Selection near =
      SimplestWithinOneStandardError({{Scores(1 + 0.9 * error, 0.3), 1, true}, {Scores(1, 0), 2, true}});
  EXPECT_EQ(near.best, 1u);
  EXPECT_EQ(near.chosen, 0u);
  EXPECT_NEAR(near.standard_error[0], error, 1e-12);
  const Selection far =
      SimplestWithinOneStandardError({{Scores(1 + 1.1 * error, 0.3), 1, true}, {Scores(1, 0), 2, true}});
  EXPECT_EQ(far.chosen, 1u);
}

TEST(OneStandardError, AmongEqualsTheBetterThenTheFirst) {
  const Selection better = SimplestWithinOneStandardError(
      {{Scores(1, 0), 3, true}, {Scores(1.02, 0.3), 1, true}, {Scores(1.01, 0.3), 1, true}});
  EXPECT_EQ(better.chosen, 2u);
  const Selection first = SimplestWithinOneStandardError({{Scores(1, 0), 1, true}, {Scores(1, 0), 1, true}});
  EXPECT_EQ(first.chosen, 0u);
}

TEST(OneStandardError, MoreHasToBeWorthHaving) {
  SelectionOptions options;
  options.worth_having = 0.1;
  const auto chosen = [&](double score) {
    return SimplestWithinOneStandardError({{Scores(score, 0), 0, true}, {Scores(1, 0), 1, true}}, options)
        .chosen;
  };
  EXPECT_EQ(chosen(1.09), 0u);  // no scatter at all, so that the standard error is 0
  EXPECT_EQ(chosen(1.11), 1u);
}

TEST(OneStandardError, TheFirstIsKeptWhereAsked) {
  SelectionOptions options;
  options.keeps_first = true;
  const std::vector<SelectionCandidate> close{{Scores(1.01, 0.3), 5, true}, {Scores(1, 0), 1, true}};
  EXPECT_EQ(SimplestWithinOneStandardError(close, options).chosen, 0u);
  EXPECT_EQ(SimplestWithinOneStandardError(close).chosen, 1u);
  EXPECT_EQ(
      SimplestWithinOneStandardError({{Scores(3, 0.3), 0, true}, {Scores(1, 0), 1, true}}, options).chosen,
      1u);
}

TEST(OneStandardError, WhatIsNotEligibleIsListedAndNeverChosen) {
  const Selection selection =
      SimplestWithinOneStandardError({{Scores(0.5, 0), 0, false}, {Scores(1, 0), 1, true}});
  EXPECT_EQ(selection.best, 1u);
  EXPECT_EQ(selection.chosen, 1u);
  EXPECT_NEAR(selection.score[0], 0.5, 1e-12);
  EXPECT_THROW(SimplestWithinOneStandardError({{Scores(1, 0), 0, false}}), std::invalid_argument);
  EXPECT_THROW(SimplestWithinOneStandardError({}), std::invalid_argument);
}

TEST(DetailChoice, NamesAndScoresStandInTheirOrder) {
  const DetailChoice choice = ChooseDetail({"coarse", "fine"}, {Scores(1.05, 0), Scores(1, 0)});
  ASSERT_EQ(choice.among.size(), 2u);
  EXPECT_EQ(choice.among[0].name, "coarse");
  EXPECT_EQ(choice.Chosen().name, "coarse");
  EXPECT_NEAR(choice.among[0].score, 1.05, 1e-12);
}

}  // namespace
}  // namespace luxfit
