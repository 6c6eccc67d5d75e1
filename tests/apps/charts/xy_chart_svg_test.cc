#include "apps/charts/xy_chart_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "apps/charts/chart_axis.h"

namespace luxfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(ChartAxisTest, TicksAreRoundAndInside) {
  EXPECT_THAT((ChartAxis{0, 1, 0, 1, false}.Ticks()),
              ElementsAre(0, testing::DoubleEq(0.2), testing::DoubleEq(0.4), testing::DoubleNear(0.6, 1e-12),
                          testing::DoubleEq(0.8), 1));
  EXPECT_THAT((ChartAxis{0.9, 21, 0, 1, true}.Ticks()), ElementsAre(1, 2, 5, 10, 20));
  EXPECT_THAT((ChartAxis{1, 2e5, 0, 1, true}.Ticks()), ElementsAre(1, 10, 100, 1000, 1e4, 1e5));
  EXPECT_THAT((ChartAxis{0.7, 0.99, 0, 1, true}.Ticks().size()), testing::Ge(3U))
      << "less than a factor of two";
}

TEST(ChartAxisTest, ValuesLieWhereTheyShould) {
  const ChartAxis log{1, 100, 10, 30, true}, linear{-1, 1, 40, 20, false};
  EXPECT_DOUBLE_EQ(log(10), 20);
  EXPECT_DOUBLE_EQ(linear(0.5), 25);
  EXPECT_DOUBLE_EQ(linear(7), 20);  // beyond: at the end
}

TEST(XyChartTest, PointsThatCannotBeDrawnBreakTheLine) {
  XyChart chart;
  chart.title = "a < b";
  chart.series = {
      {"one", {{1, 1}, {2, 2}, {3, std::numeric_limits<double>::quiet_NaN()}, {4, 4}, {5, 5}}, {}, true}};
  const std::string svg = XyChartsSvg({chart});
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  const std::size_t begin = svg.find("<path d=\""), end = svg.find("fill", begin);
  const std::string path = svg.substr(begin, end - begin);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 2);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'L'), 2);
}

TEST(XyChartTest, LabelsOfPointsThatCoincideStandApart) {
  XyChart chart;
  chart.series = {{"one", {{1, 1}, {1, 1}}, {"first", "second"}, false}};
  const std::string svg = XyChartsSvg({chart});
  const auto before = [&svg](const std::string& label) {
    const std::size_t end = svg.find(">" + label + "<"), begin = svg.rfind("<text", end);
    return svg.substr(begin, svg.find("font-size", begin) - begin);
  };
  EXPECT_NE(before("first"), before("second"));
}

TEST(XyChartTest, TheLegendNamesWhatIsDrawn) {
  XyChart chart;
  chart.series = {{"one\ntwo", {{1, 1}}, {}, false}, {"none", {}, {}, false}};
  const std::string svg = XyChartsSvg({chart});
  EXPECT_THAT(svg, testing::AllOf(HasSubstr(">one<"), HasSubstr(">two<"), Not(HasSubstr("none<"))));
}

TEST(XyChartTest, NothingToDrawIsNothing) {
  EXPECT_EQ(XyChartsSvg({XyChart{}}), "");
  XyChart chart;
  chart.y.is_log = true;
  chart.series = {{"one", {{1, 0}}, {}, true}};
  EXPECT_EQ(XyChartsSvg({chart}), "");
}

}  // namespace
}  // namespace luxfit
