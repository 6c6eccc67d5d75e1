#include "inverse/study/stability_score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

EstimatedLuminaire At(const std::string& id, const Eigen::Vector3d& position, double flux,
                      double position_sigma_m = 0.001, double flux_sigma = 10) {
  return {id, position, Eigen::Vector3d::Constant(position_sigma_m), flux, flux_sigma};
}

const std::vector<EstimatedLuminaire> kTruth{At("A", {0, 0, 2}, 1000), At("B", {2, 0, 2}, 500)};

TEST(StabilityScore, WhatIsNearIsASuccess) {
  const FitScore score =
      ScoreFit({At("A", {0.03, 0.03, 2}, 1090, 0.05, 100), At("B", {2, 0, 2}, 500)}, kTruth, false);
  EXPECT_TRUE(score.is_success);
  EXPECT_FALSE(score.is_confident_wrong);
  EXPECT_NEAR(score.worst_position_m, 0.03 * std::sqrt(2), 1e-12);
  EXPECT_NEAR(score.position_error_m, 0.015 * std::sqrt(2), 1e-12);
  EXPECT_NEAR(score.worst_flux, 0.09, 1e-12);
  EXPECT_EQ(score.intervals, 4);
  EXPECT_EQ(score.intervals_held, 4);
}

TEST(StabilityScore, WrongAndSureIsWorseThanWrongAndWarned) {
  const std::vector<EstimatedLuminaire> found{At("A", {0.2, 0, 2}, 1000), At("B", {2, 0, 2}, 500)};
  EXPECT_TRUE(ScoreFit(found, kTruth, false).is_confident_wrong);
  EXPECT_FALSE(ScoreFit(found, kTruth, true).is_confident_wrong);
  EXPECT_FALSE(ScoreFit(found, kTruth, true).is_success);
  EXPECT_EQ(ScoreFit(found, kTruth, false).intervals_held, 3);
}

TEST(StabilityScore, WrongWithinItsIntervalIsHonest) {
  const FitScore score =
      ScoreFit({At("A", {0.2, 0, 2}, 1000, 0.1), At("B", {2, 0, 2}, 700, 0.001, 150)}, kTruth, false);
  EXPECT_FALSE(score.is_success);
  EXPECT_FALSE(score.is_confident_wrong);
}

TEST(StabilityScore, SlightlyOutOfItsIntervalIsNoWrongResult) {
  const FitScore score = ScoreFit({At("A", {0.02, 0, 2}, 1000), At("B", {2, 0, 2}, 500)}, kTruth, false);
  EXPECT_TRUE(score.is_success);
  EXPECT_FALSE(score.is_confident_wrong);
  EXPECT_EQ(score.intervals_held, 3);
}

// Estimates whose errors have the sigmas that they state: nineteen of twenty intervals hold the truth. The
// binomial sigma of 4000 draws is 0.34 %; the tolerance is three of them.
TEST(StabilityScore, IntervalsHoldNineteenOfTwentyHonestErrors) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  constexpr int kDraws = 4000;
  const double three_sigmas = 3 * std::sqrt(0.95 * 0.05 / kDraws);
  const Eigen::Vector3d sigma_m(0.01, 0.02, 0.005);
  int places_held = 0, fluxes_held = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    EstimatedLuminaire placed = kTruth[0], powered = kTruth[0];
    placed.position += sigma_m.cwiseProduct(Eigen::Vector3d(normal(rng), normal(rng), normal(rng)));
    placed.position_sigma_m = sigma_m;
    placed.flux_sigma = 0;  // given: no interval
    powered.flux += 30 * normal(rng);
    powered.flux_sigma = 30;
    powered.position_sigma_m.setZero();
    const FitScore of_place = ScoreFit({placed}, {kTruth[0]}, false),
                   of_flux = ScoreFit({powered}, {kTruth[0]}, false);
    ASSERT_EQ(of_place.intervals, 1);
    ASSERT_EQ(of_flux.intervals, 1);
    places_held += of_place.intervals_held;
    fluxes_held += of_flux.intervals_held;
  }
  EXPECT_NEAR(static_cast<double>(places_held) / kDraws, 0.95, three_sigmas);
  EXPECT_NEAR(static_cast<double>(fluxes_held) / kDraws, 0.95, three_sigmas);
}

TEST(StabilityScore, WhatIsMissingOrUndeterminedIsNoSuccess) {
  EXPECT_EQ(ScoreFit({At("A", {0, 0, 2}, 1000)}, kTruth, false).missing, 1);
  EXPECT_FALSE(ScoreFit({At("A", {0, 0, 2}, 1000)}, kTruth, false).is_success);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const FitScore score = ScoreFit({At("A", {0, 0, 2}, 1000, nan), At("B", {2, 0, 2}, 500)}, kTruth, false);
  EXPECT_FALSE(score.is_success);
  EXPECT_FALSE(score.is_confident_wrong);
  EXPECT_EQ(score.intervals, 3);
  const FitScore none = ScoreFit({}, kTruth, true);
  EXPECT_EQ(none.missing, 2);
  EXPECT_TRUE(std::isnan(none.position_error_m));
}

TEST(StabilityScore, NamesThatAreNotThereAreMatchedByPlace) {
  const FitScore score = ScoreFit({At("L1", {2, 0, 2}, 500), At("L2", {0, 0, 2}, 1000)}, kTruth, false);
  EXPECT_TRUE(score.is_success);
  EXPECT_NEAR(score.worst_position_m, 0, 1e-12);
}

TEST(StabilityScore, AnEdgeIsTheFirstLevelBelowNineInTen) {
  std::vector<LevelSummary> levels(3);
  for (LevelSummary& level : levels) level.trials = level.successes = 10;
  EXPECT_FALSE(FirstBadLevel(levels).has_value());
  levels[1].successes = 9;
  EXPECT_FALSE(FirstBadLevel(levels).has_value());
  levels[2].successes = 8;
  EXPECT_EQ(FirstBadLevel(levels), 2u);
}

TEST(StabilityScore, MediansLeaveOutWhatFoundNothing) {
  FitScore good, none = ScoreFit({}, kTruth, true);
  good.is_success = true;
  good.position_error_m = 0.01;
  good.flux_error = 0.02;
  const LevelSummary summary = SummarizeTrials({good, none, good});
  EXPECT_EQ(summary.trials, 3);
  EXPECT_NEAR(summary.SuccessRate(), 2.0 / 3, 1e-12);
  EXPECT_NEAR(summary.median_position_error_m, 0.01, 1e-12);
}

}  // namespace
}  // namespace luxfit
