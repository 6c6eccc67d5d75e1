#include "apps/text/formats/units.h"

#include <gtest/gtest.h>

namespace luxfit {
namespace {

TEST(UnitFactor, IsThatOfNamesThatDifferByTheirUnit) {
  EXPECT_EQ(UnitFactor("x_mm", "x_m"), 0.001);
  EXPECT_EQ(UnitFactor("x_m", "x_m"), 1);
  EXPECT_EQ(UnitFactor("exposure_ms", "exposure_s"), 0.001);
  EXPECT_EQ(UnitFactor("illuminance_klx", "illuminance_lx"), 1000);
  EXPECT_NEAR(UnitFactor("illuminance_fc", "illuminance_lx").value(), 10.7639104, 1e-7);  // NIST SP 811
  EXPECT_NEAR(UnitFactor("illuminance_lx", "illuminance_fc").value(), 0.09290304, 1e-12);
}

TEST(UnitFactor, OtherNamesHaveNone) {
  EXPECT_FALSE(UnitFactor("y_mm", "x_m"));
  EXPECT_FALSE(UnitFactor("x_lx", "x_m"));
  EXPECT_FALSE(UnitFactor("x", "x_m"));
  EXPECT_FALSE(UnitFactor("lux", "illuminance_lx"));
}

}  // namespace
}  // namespace luxfit
