#include "calib/luminance/median.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

TEST(Median, MiddleOfAnOddCountAndMeanOfTheMiddleTwoOfAnEvenOne) {
  EXPECT_EQ(Median({7}), 7);
  EXPECT_EQ(Median({9, 1, 4}), 4);
  EXPECT_EQ(Median({9, 1, 4, 2}), 3);
  EXPECT_TRUE(std::isnan(Median({})));
}

TEST(Quantile, IsTheNumberOfTheShareOfTheRanks) {
  const std::vector<double> tens{90, 10, 40, 20, 80, 0, 70, 50, 60, 30};  // 10 times the rank
  EXPECT_EQ(Quantile(tens, 0), 0);
  EXPECT_EQ(Quantile(tens, 0.1), 10);
  EXPECT_EQ(Quantile(tens, 0.19), 10);
  EXPECT_EQ(Quantile(tens, 0.5), 50);
  EXPECT_EQ(Quantile(tens, 0.75), 70);
  EXPECT_EQ(Quantile(tens, 1), 90);
}

TEST(Quantile, HalfIsTheMiddleAndTheUpperOfTheMiddleTwo) {
  EXPECT_EQ(Quantile({7}, 0.5), 7);
  EXPECT_EQ(Quantile({9, 1, 4}, 0.5), 4);
  EXPECT_EQ(Quantile({9, 1, 4, 2}, 0.5), 4);
}

TEST(Quantile, OfNoNumbersIsNotKnownAndAShareIsFromZeroToOne) {
  EXPECT_TRUE(std::isnan(Quantile({}, 0.5)));
  EXPECT_THROW(Quantile({1, 2}, -0.1), std::invalid_argument);
  EXPECT_THROW(Quantile({1, 2}, 1.1), std::invalid_argument);
  EXPECT_THROW(Quantile({1, 2}, NAN), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
