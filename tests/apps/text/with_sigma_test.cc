#include "apps/text/with_sigma.h"

#include <gtest/gtest.h>

#include <limits>

namespace luxfit {
namespace {

TEST(WithSigma, ShowsAsManyDecimalsAsTheSigmaHas) {
  EXPECT_EQ(WithSigma(0.0831380, 0.0000349), "0.083138 ± 0.000035");
  EXPECT_EQ(WithSigma(534.3012, 0.2987), "534.30 ± 0.30");
  EXPECT_EQ(WithSigma(-12.4, 34), "-12 ± 34");
}

TEST(WithSigma, SaysThatASigmaIsNotKnown) {
  EXPECT_EQ(WithSigma(0.25, std::numeric_limits<double>::quiet_NaN()), "0.25 ± ?");
  EXPECT_EQ(WithSigma(0.25, 0), "0.25 ± ?");
}

}  // namespace
}  // namespace luxfit
