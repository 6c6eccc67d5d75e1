#include "apps/charts/speed_accuracy_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace luxfit {
namespace {

using testing::HasSubstr;

ChartPoint PointOf(const char* factor, double time_s, double error_percent, bool on_front) {
  ChartPoint point;
  point.factor = factor;
  point.method = FormFactorMethod::kHybrid;
  point.time_s = time_s;
  point.error_percent = error_percent;
  point.on_front = on_front;
  point.automatic = std::string(factor) == "automatic";
  return point;
}

Chart PresentChart() {
  Chart chart;
  chart.points = {PointOf("automatic", 1, 2, true), PointOf("grid", 3, 1, true),
                  PointOf("bounces", 2, 8, false)};
  chart.reference.sigma_percent = 0.5;
  return chart;
}

const XySeries& SeriesOf(const XyChart& chart, const std::string& name_begin) {
  return *std::find_if(chart.series.begin(), chart.series.end(), [&](const XySeries& series) {
    return series.name.rfind(name_begin, 0) == 0 && !series.name.empty();
  });
}

TEST(SpeedAccuracyChartTest, EachPointLiesInTheSeriesOfItsKind) {
  const XyChart chart = SpeedAccuracyChart(PresentChart(), "room");
  EXPECT_EQ(SeriesOf(chart, "hybrid").points.size(), 2U);
  EXPECT_EQ(SeriesOf(chart, "bounces").points.size(), 1U);
  const std::vector<Eigen::Vector2d> steps{{1, 2}, {3, 2}, {3, 1}, {*chart.x.max, 1}};
  EXPECT_EQ(SeriesOf(chart, "Pareto front").points, steps);
  EXPECT_EQ(SeriesOf(chart, "noise").points.front().y(), 0.5);
  EXPECT_EQ(chart.series.back().name.rfind("automatic: hybrid", 0), 0U) << "drawn last: the ring lies above";
  EXPECT_TRUE(chart.keys.empty());
}

TEST(SpeedAccuracyChartTest, AnEarlierChartLiesBelow) {
  const std::vector<ChartPoint> before{PointOf("automatic", 10, 4, true), PointOf("bounces", 0.1, 9, false)};
  const XyChart chart = SpeedAccuracyChart(PresentChart(), "room", before, {"old", "new"});
  ASSERT_EQ(chart.keys.size(), 2U);
  EXPECT_LT(*chart.x.min, 0.1);
  EXPECT_GT(*chart.x.max, 10);
  const auto is_faint_at = [&](double time_s) {
    return std::any_of(chart.series.begin(), chart.series.end(), [&](const XySeries& series) {
      return series.style && series.style->is_dashed && series.points.size() == 1 &&
             series.points.front().x() == time_s;
    });
  };
  EXPECT_TRUE(is_faint_at(10));
  EXPECT_TRUE(is_faint_at(0.1));
  const std::string svg = XyChartsSvg({chart});
  EXPECT_THAT(svg, testing::AllOf(HasSubstr(">old<"), HasSubstr(">new<"), HasSubstr(">automatic: hybrid<")));
  EXPECT_EQ(svg.find(">automatic<"), std::string::npos) << "the present choice names both rings";
}

TEST(SpeedAccuracyChartTest, WithoutPointsThereIsNoChart) {
  EXPECT_TRUE(SpeedAccuracyChart({}, "room", PresentChart().points).series.empty());
}

}  // namespace
}  // namespace luxfit
