// The picture of one degradation, with the levels of an earlier chart in it.
#include "apps/commands/study/internal/stability_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace luxfit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

DegradationResult Noise() {
  DegradationResult result;
  result.degradation = {"noise", "%", "noise of a pixel, %", {2, 10}, true, nullptr, nullptr};
  for (const double level : result.degradation.levels) {
    LevelResult l;
    l.level = level;
    l.summary.trials = 4;
    l.summary.successes = 3;
    l.summary.intervals = 8;
    l.summary.intervals_held = 7;
    l.summary.median_position_error_m = 0.002;
    l.summary.median_flux_error = 0.005;
    l.median_lux_error_percent = 0.8;
    result.levels.push_back(l);
  }
  return result;
}

// Returns the rows of that degradation, of three trials each.
std::vector<StabilityRow> RowsOf(const std::string& degradation) {
  StabilityRow row{degradation, 2, "%", 3, 100, 0, 0, 0, 100, 4, 1, 2};
  StabilityRow worse = row;
  worse.level = 10;
  worse.success_percent = 50;
  return {row, worse};
}

TEST(StabilityChartTest, TheTableHasRatesInPercent) {
  EXPECT_THAT(StabilityCsv({Noise()}), HasSubstr("\nnoise,2,%,4,75,0,0,0,87.5,2,0.5,0.8\n"));
}

TEST(StabilityChartTest, TheEarlierLevelsOfTheSameDegradationAreDrawn) {
  const std::string alone = StabilitySvg(Noise(), {"office", 4, {}, {}});
  EXPECT_THAT(alone, AllOf(Not(HasSubstr("stroke-dasharray")), HasSubstr("4 trials a level;")));
  const std::string both = StabilitySvg(Noise(), {"office", 4, RowsOf("noise"), {"old", "new"}});
  EXPECT_THAT(both, AllOf(HasSubstr("stroke-dasharray"), HasSubstr(">old<"), HasSubstr(">new<"),
                          HasSubstr("4 trials a level (old: 3);")));
  EXPECT_EQ(StabilitySvg(Noise(), {"office", 4, RowsOf("exposure"), {"old", "new"}}), alone);
}

}  // namespace
}  // namespace luxfit
