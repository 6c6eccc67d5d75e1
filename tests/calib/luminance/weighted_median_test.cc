#include "calib/luminance/weighted_median.h"

#include <gtest/gtest.h>

#include <cmath>

namespace luxfit {
namespace {

TEST(WeightedMedian, HalfOfTheWeightLiesBelow) {
  EXPECT_EQ(WeightedMedian({{3, 1}, {1, 1}, {2, 1}}), 2);
  EXPECT_EQ(WeightedMedian({{3, 1}, {1, 10}, {2, 1}}), 1);
  EXPECT_EQ(WeightedMedian({{3, 5}, {1, 1}, {2, 1}}), 3);
  EXPECT_TRUE(std::isnan(WeightedMedian({})));
}

}  // namespace
}  // namespace luxfit
