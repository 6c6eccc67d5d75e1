#include "calib/register/millimetres.h"

#include <gtest/gtest.h>

#include <limits>

namespace luxfit {
namespace {

TEST(Millimetres, HaveTwoDigitsAndNoExponent) {
  EXPECT_EQ(Millimetres(0.00025), "0.25 mm");
  EXPECT_EQ(Millimetres(0.0041), "4.1 mm");
  EXPECT_EQ(Millimetres(0.0415), "42 mm");
  EXPECT_EQ(Millimetres(0.183), "183 mm");
  EXPECT_EQ(Millimetres(12.345), "12345 mm");
  EXPECT_EQ(Millimetres(-0.002), "-2.0 mm");
  EXPECT_EQ(Millimetres(0), "0 mm");
  EXPECT_EQ(Millimetres(std::numeric_limits<double>::infinity()), "an unknown length");
}

}  // namespace
}  // namespace luxfit
