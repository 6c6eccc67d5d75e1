#include "forward/room/internal/polar_angle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace luxfit {
namespace {

TEST(PolarAngle, IsThatOfAtan2) {
  constexpr int kSteps = 20000;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = M_PI * i / kSteps;
    const double sine = 3 * std::abs(std::sin(angle)), cosine = 3 * std::cos(angle);
    EXPECT_NEAR(PolarAngle(sine, cosine), std::atan2(sine, cosine), 2e-14) << angle;
  }
}

TEST(PolarAngle, HasLimits) {
  EXPECT_EQ(PolarAngle(0, 1), 0);
  EXPECT_DOUBLE_EQ(PolarAngle(0, -1), M_PI);
  EXPECT_DOUBLE_EQ(PolarAngle(1, 0), M_PI / 2);
  EXPECT_EQ(PolarAngle(0, 0), 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(PolarAngle(nan, 1)));
  EXPECT_TRUE(std::isnan(PolarAngle(1, nan)));
}

}  // namespace
}  // namespace luxfit
