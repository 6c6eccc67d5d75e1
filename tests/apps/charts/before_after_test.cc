#include "apps/charts/before_after.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace luxfit {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

XyChart ChartOf(std::vector<XySeries> series) {
  XyChart chart;
  chart.series = std::move(series);
  return chart;
}

int Count(const std::string& text, const std::string& what) {
  int count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(LighterToneTest, IsHalfWayToWhite) {
  EXPECT_EQ(LighterTone("#000000"), "#7f7f7f");
  EXPECT_EQ(LighterTone("#ffffff"), "#ffffff");
  EXPECT_EQ(LighterTone("#D55e00"), "#eaae7f");
  for (const char* other : {"red", "#12345", "#12345g", "1234567"})
    EXPECT_THROW(LighterTone(other), std::invalid_argument) << other;
}

TEST(WithBeforeTest, AnEarlierSeriesLiesBelowInALighterTone) {
  const XyChart after = ChartOf({{"one", {{1, 1}, {2, 2}}, {"a", "b"}}, {"two", {{1, 3}, {2, 4}}, {}}});
  const XyChart before = ChartOf({{"two", {{1, 5}, {2, 6}}, {"c", "d"}}});
  const XyChart both = WithBefore(after, before, {"old", "new"});
  ASSERT_EQ(both.series.size(), 3U);
  const XySeries &faint = both.series[0], &one = both.series[1], &two = both.series[2];
  EXPECT_EQ(faint.points, before.series[0].points);
  EXPECT_TRUE(faint.name.empty()) << "the legend has the present series' entry";
  EXPECT_TRUE(faint.labels.empty());
  EXPECT_TRUE(faint.style->is_dashed);
  EXPECT_EQ(faint.style->colour, LighterTone(XyStyleAt(1).colour));
  EXPECT_EQ(faint.style->mark, XyStyleAt(1).mark);
  EXPECT_LT(faint.style->radius_px, two.style->radius_px);
  EXPECT_EQ(one.style->colour, XyStyleAt(0).colour) << "as without an earlier chart";
  EXPECT_EQ(two.style->colour, XyStyleAt(1).colour);
  EXPECT_EQ(one.labels, after.series[0].labels);
  EXPECT_FALSE(two.style->is_dashed);
}

TEST(WithBeforeTest, ThePictureNamesBothChartsInTheLegend) {
  const XyChart chart = ChartOf({{"one", {{1, 1}, {2, 2}}, {}}});
  const std::string svg = XyChartsSvg({WithBefore(chart, chart, {"a & b", "c"})});
  EXPECT_THAT(svg, testing::AllOf(HasSubstr(">a &amp; b<"), HasSubstr(">c<")));
  EXPECT_EQ(Count(svg, ">one<"), 1);
  EXPECT_EQ(Count(svg, "stroke-dasharray"), 2) << "the earlier line, and its entry in the legend";
  EXPECT_EQ(Count(XyChartsSvg({chart}), "stroke-dasharray"), 0);
}

TEST(WithBeforeTest, ASeriesThatOnlyTheEarlierChartHasKeepsItsName) {
  const XyChart after = ChartOf({{"one", {{1, 1}}, {}}, {"empty", {}, {}}});
  const XyChart both = WithBefore(after, ChartOf({{"gone", {{1, 2}}, {}}, {"empty", {{2, 2}}, {}}}), {});
  EXPECT_EQ(both.series[0].name, "gone");
  EXPECT_EQ(both.series[0].style->colour, LighterTone(XyStyleAt(2).colour)) << "a colour of its own";
  EXPECT_EQ(both.series[1].name, "empty");
  EXPECT_THAT(XyChartsSvg({both}), testing::AllOf(HasSubstr(">gone<"), HasSubstr(">empty<")));
}

TEST(WithBeforeTest, LimitsSpanBothCharts) {
  XyChart after = ChartOf({{"one", {{1, 1}}, {}}}), before = after;
  after.x = {"s", true, 1, 10};
  before.x = {"s", true, 0.5, 8};
  after.y.min = 0;
  const XyChart both = WithBefore(after, before, {});
  EXPECT_EQ(both.x.min, 0.5);
  EXPECT_EQ(both.x.max, 10);
  EXPECT_EQ(both.y.min, 0);
}

TEST(WithBeforeTest, NothingToDrawBeforeLeavesTheChartAlone) {
  const XyChart after = ChartOf({{"one", {{1, 1}}, {}}});
  for (const XyChart& before : {ChartOf({}), ChartOf({{"one", {{kNan, 1}}, {}}})}) {
    const XyChart both = WithBefore(after, before, {});
    EXPECT_TRUE(both.keys.empty());
    EXPECT_EQ(XyChartsSvg({both}), XyChartsSvg({after}));
  }
}

}  // namespace
}  // namespace luxfit
