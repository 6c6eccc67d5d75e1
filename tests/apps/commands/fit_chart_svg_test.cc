// Pictures of `luxfit chart --fit`: slopes in closed form, and an earlier chart in the same picture.
#include "apps/commands/study/internal/fit_chart_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace luxfit {
namespace {

using testing::HasSubstr;

// Fits over the number of views whose time is factor_s n^exponent, with 3 photos a view.
std::vector<FitPoint> ViewsOf(double factor_s, double exponent) {
  std::vector<FitPoint> points;
  points.reserve(4);
  for (const int views : {1, 2, 4, 8}) {
    FitPoint point;
    point.factor = "views";
    point.value = views;
    point.photos = 3 * views;
    point.time_s = factor_s * std::pow(views, exponent);
    point.position_mm = 16.0 / views;
    points.push_back(point);
  }
  return points;
}

const XyChart& ChartOf(const std::vector<FitPicture>& pictures, const std::string& file) {
  for (const FitPicture& picture : pictures) {
    if (picture.file == file) return picture.chart;
  }
  throw std::invalid_argument(file);
}

TEST(FitSlopesTest, AreTheExponents) {
  EXPECT_NEAR(FitSlopes(ViewsOf(0.7, 1.5)).at("photos"), 1.5, 1e-12);
  EXPECT_EQ(FitSlopes(ViewsOf(0.7, 1.5)).size(), 1U) << "no other size varies";
}

TEST(FitSlopesTest, LeaveOutFitsThatDoNotStand) {
  std::vector<FitPoint> points = ViewsOf(1, 2);
  points[3].time_s = 1e3;
  points[3].is_usable = false;
  EXPECT_NEAR(FitSlopes(points).at("photos"), 2, 1e-12);
  points.resize(1);
  EXPECT_TRUE(FitSlopes(points).empty());
}

TEST(FitPicturesTest, AreFourEachWithItsUnit) {
  const std::vector<FitPicture> pictures = FitPictures(ViewsOf(1, 1), "office");
  ASSERT_EQ(pictures.size(), 4U);
  EXPECT_EQ(ChartOf(pictures, "fit_position.svg").y.label, "median error of position, mm");
  EXPECT_EQ(ChartOf(pictures, "fit_flux.svg").y.label, "median error of flux, %");
  EXPECT_EQ(ChartOf(pictures, "fit_lux.svg").y.label, "mean error, % of the mean reading");
  const XySeries& views = ChartOf(pictures, "fit_position.svg").series.at(0);
  EXPECT_EQ(views.points.at(1), Eigen::Vector2d(2, 8));
  EXPECT_EQ(views.labels.at(1), "2");
  EXPECT_EQ(ChartOf(pictures, "fit_cost.svg").series.at(0).name, "photos: slope 1.00");
  EXPECT_EQ(XyChartsSvg({ChartOf(pictures, "fit_lux.svg")}), "") << "no readings that only check";
}

TEST(FitPicturesTest, AnEarlierChartLiesInTheSamePicture) {
  const std::vector<FitPicture> pictures =
      FitPictures(ViewsOf(1, 1), "office", ViewsOf(4, 2), {"0.1.0", "0.2.0"});
  const XyChart& position = ChartOf(pictures, "fit_position.svg");
  ASSERT_EQ(position.series.size(), 2U);
  EXPECT_EQ(position.series[0].points.at(1), Eigen::Vector2d(16, 8));
  EXPECT_TRUE(position.series[0].style->is_dashed);
  EXPECT_EQ(position.series[1].points.at(1), Eigen::Vector2d(2, 8));
  EXPECT_FALSE(position.series[1].style->is_dashed);
  EXPECT_THAT(XyChartsSvg({position}), testing::AllOf(HasSubstr(">0.1.0<"), HasSubstr(">0.2.0<")));
}

TEST(FitPicturesTest, TheCostOfBothIsInTheUnitsOfThePresentOne) {
  const std::vector<FitPicture> pictures =
      FitPictures(ViewsOf(1, 1), "office", ViewsOf(4, 2), {"0.1.0", "0.2.0"});
  const XyChart& cost = ChartOf(pictures, "fit_cost.svg");
  ASSERT_EQ(cost.series.size(), 2U);
  EXPECT_EQ(cost.series[0].points.back(), Eigen::Vector2d(1, 32)) << "4 x 8^2 s, of 8 s";
  EXPECT_EQ(cost.series[1].points.back(), Eigen::Vector2d(1, 1));
  EXPECT_EQ(cost.series[1].name, "photos: slope 1.00\n0.1.0: 2.00");
  EXPECT_THAT(cost.subtitle, HasSubstr("the largest of \"0.2.0\""));
}

}  // namespace
}  // namespace luxfit
