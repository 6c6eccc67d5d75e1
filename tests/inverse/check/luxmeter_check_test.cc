#include "inverse/check/luxmeter_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace luxfit {
namespace {

CheckedReading Checked(double measured_lx, double predicted_lx, double measured_sigma_lx = 0,
                       double predicted_sigma_lx = 0) {
  return {measured_lx, predicted_lx, measured_sigma_lx, predicted_sigma_lx};
}

TEST(SummarizeLuxmeter, MeanErrorIsOfTheMeanReading) {
  // Errors 10, 5, 0 lx of readings 100, 50, 250: mean 5 lx, of the mean 133.33 lx 3.75 %; the worst of its
  // own value 10 %.
  const LuxmeterSummary summary = SummarizeLuxmeter({Checked(100, 110), Checked(50, 45), Checked(250, 250)});
  EXPECT_EQ(summary.readings_checked, 3);
  EXPECT_NEAR(summary.mean_abs_error_lx, 5, 1e-12);  // double rounding, here and below
  EXPECT_NEAR(summary.mean_abs_error_percent, 3.75, 1e-12);
  EXPECT_NEAR(summary.max_abs_error_percent, 10, 1e-12);
}

TEST(SummarizeLuxmeter, NoReadingsHaveNoError) {
  const LuxmeterSummary summary = SummarizeLuxmeter({});
  EXPECT_EQ(summary.readings_checked, 0);
  EXPECT_TRUE(std::isnan(summary.mean_abs_error_lx));
  EXPECT_TRUE(std::isnan(summary.mean_abs_error_percent));
  EXPECT_TRUE(std::isnan(summary.max_abs_error_percent));
}

TEST(SummarizeLuxmeter, AReadingOfNothingHasNoPercentOfItsOwn) {
  const LuxmeterSummary summary = SummarizeLuxmeter({Checked(0, 3), Checked(100, 101)});
  EXPECT_NEAR(summary.max_abs_error_percent, 1, 1e-12);   // double rounding
  EXPECT_NEAR(summary.mean_abs_error_percent, 4, 1e-12);  // 2 of 50 lx
  EXPECT_EQ(SummarizeLuxmeter({Checked(0, 3)}).mean_abs_error_percent, 0);
}

// Predictions that are 8 % too large, in turn for meters of 2, 4 and 6 %: these explain 1.6, 3.2 and 4.8 % in the mean.
TEST(ContradictTheFit, WhereTheMeterExplainsLessThanHalf) {
  for (const double sigma : {0.02, 0.04, 0.06}) {
    const std::vector<CheckedReading> readings = {{100, 108, 100 * sigma, 0}, {300, 324, 300 * sigma, 0}};
    EXPECT_NEAR(ExplainedByTheMeterPercent(readings), 100 * sigma * std::sqrt(2 / M_PI), 1e-2);
    EXPECT_EQ(ContradictTheFit(readings), sigma < 0.05) << sigma;
  }
}

TEST(ContradictTheFit, SmallErrorsAndNoReadingsDoNot) {
  EXPECT_FALSE(ContradictTheFit({{100, 104.9, 0.1, 0}}));
  EXPECT_TRUE(ContradictTheFit({{100, 105.1, 0.1, 0}}));
  EXPECT_FALSE(ContradictTheFit({}));
}

// One of five that was read twice too high is off by 20 % in the mean of all. Nobody knows which of two is wrong.
TEST(ContradictTheFit, OneReadingAloneDoesNot) {
  const CheckedReading right{100, 100, 1, 0}, twice{200, 100, 2, 0};
  EXPECT_FALSE(ContradictTheFit({right, twice, right, right, right}));
  EXPECT_TRUE(ContradictTheFit({right, twice, right, twice, right}));
  EXPECT_TRUE(ContradictTheFit({right, twice}));
}

TEST(ZScore, AddsTheSigmasInSquares) {
  EXPECT_NEAR(ZScore(Checked(110, 100, 3, 4)), 2, 1e-12);  // 10 / 5
  EXPECT_NEAR(ZScore(Checked(95, 100, 5, 0)), -1, 1e-12);  // below the prediction is negative
  EXPECT_EQ(ZScore(Checked(110, 100)), 0);
}

}  // namespace
}  // namespace luxfit
