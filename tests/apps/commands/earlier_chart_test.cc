// Tables of earlier charts: what is read, and what is refused.
#include "apps/commands/study/internal/earlier_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "apps/commands/study/internal/fit_chart_points.h"
#include "apps/commands/study/internal/forward_chart_table.h"
#include "apps/commands/study/internal/stability_chart.h"
#include "apps/text/formats/artifact.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Tables as the program wrote them (docs/charts).
constexpr char kFit[] =
    "factor,value,patches,photos,luminaires,observations,processor_time_s,usable,position_mm,flux_percent,"
    "lux_percent\n"
    "elements,250,849,43,4,3287,3.04,1,3.561,0.329,0.8564\n"
    "views,1,849,6,4,2381,4.2,0,,,0.7643\n";
constexpr char kStability[] =
    "degradation,level,unit,trials,success_percent,confident_wrong_percent,warned_percent,"
    "undetermined_percent,intervals_held_percent,median_position_mm,median_flux_percent,median_lux_percent\n"
    "noise,2,%,3,100,0,0,0,87.5,3.876,0.3642,0.879\n"
    "noise,300,%,3,0,0,100,100,,,,\n";
constexpr char kForward[] =
    "factor,method,rays,patch_size_m,element_size_m,adaptive,bounces,solver,patches,time_s,error_percent,"
    "estimated_error_percent,on_front,automatic\n"
    "automatic,malley_stratified,32,0.8,0.2,0,all,conjugate_gradient,201,0.03472,0.2624,0.5549,0,1\n"
    "rays,hybrid,8,0.8,0.2,0,all,conjugate_gradient,201,0.02,0.5,,1,0\n";

class EarlierChartTest : public testing::Test {
 protected:
  EarlierChartTest() {
    folder_.Write("fit/fit.csv", kFit);
    folder_.Write("stability/stability.csv", kStability);
    folder_.Write("forward/chart.csv", kForward);
  }

  CsvTable Read(const std::string& name, ChartKind kind, const std::string& truth_path = "") const {
    return ReadEarlierChart(folder_.Path(name), {kind, "office", truth_path});
  }

  // Returns the message that refuses the chart.
  std::string Refused(const std::string& name, ChartKind kind, const std::string& truth_path = "") const {
    try {
      Read(name, kind, truth_path);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "nothing was thrown";
  }

  TempFolder folder_;
};

TEST_F(EarlierChartTest, AFitChartIsReadFromItsFolderOrItsTable) {
  for (const char* name : {"fit", "fit/", "fit/fit.csv"}) {
    const std::vector<FitPoint> points = FitPointsOf(Read(name, ChartKind::kFit));
    ASSERT_EQ(points.size(), 2U) << name;
    EXPECT_EQ(points[0].factor, "elements");
    EXPECT_EQ(points[0].value, 250);
    EXPECT_EQ(points[0].patches, 849);
    EXPECT_EQ(points[0].photos, 43);
    EXPECT_EQ(points[0].luminaires, 4);
    EXPECT_EQ(points[0].observations, 3287);
    EXPECT_EQ(points[0].time_s, 3.04);
    EXPECT_TRUE(points[0].is_usable);
    EXPECT_EQ(points[0].position_mm, 3.561);
    EXPECT_EQ(points[0].flux_percent, 0.329);
    EXPECT_EQ(points[0].lux_percent, 0.8564);
    EXPECT_FALSE(points[1].is_usable);
    EXPECT_TRUE(std::isnan(points[1].position_mm));
    EXPECT_TRUE(std::isnan(points[1].flux_percent));
    EXPECT_EQ(points[1].lux_percent, 0.7643);
    EXPECT_EQ(FitChartCsv(points), kFit);
  }
}

TEST_F(EarlierChartTest, AStabilityChartIsRead) {
  const std::vector<StabilityRow> rows = StabilityRowsOf(Read("stability", ChartKind::kStability));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].degradation, "noise");
  EXPECT_EQ(rows[0].level, 2);
  EXPECT_EQ(rows[0].unit, "%");
  EXPECT_EQ(rows[0].trials, 3);
  EXPECT_EQ(rows[0].success_percent, 100);
  EXPECT_EQ(rows[0].intervals_held_percent, 87.5);
  EXPECT_EQ(rows[0].median_position_mm, 3.876);
  EXPECT_EQ(rows[0].median_flux_percent, 0.3642);
  EXPECT_EQ(rows[0].median_lux_percent, 0.879);
  EXPECT_EQ(rows[1].warned_percent, 100);
  EXPECT_EQ(rows[1].undetermined_percent, 100);
  EXPECT_TRUE(std::isnan(rows[1].median_position_mm));
}

TEST_F(EarlierChartTest, AForwardChartIsRead) {
  const std::vector<ChartPoint> points = ForwardPointsOf(Read("forward", ChartKind::kForward));
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].method, FormFactorMethod::kMalleyStratified);
  EXPECT_TRUE(points[0].automatic);
  EXPECT_FALSE(points[0].on_front);
  EXPECT_EQ(points[1].factor, "rays");
  EXPECT_EQ(points[1].method, FormFactorMethod::kHybrid);
  EXPECT_EQ(points[1].time_s, 0.02);
  EXPECT_EQ(points[1].error_percent, 0.5);
  EXPECT_TRUE(points[1].on_front);
  folder_.Replace("forward/chart.csv", "hybrid", "hybird");
  try {
    ForwardPointsOf(Read("forward", ChartKind::kForward));
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("chart.csv:3: method: expected"), HasSubstr("mean \"hybrid\"")));
  }
}

TEST_F(EarlierChartTest, AMissingChartIsNamed) {
  EXPECT_THAT(Refused("none", ChartKind::kFit),
              AllOf(HasSubstr(folder_.Path("none") + ": expected a chart of `luxfit chart --fit`"),
                    HasSubstr("fit.csv"), HasSubstr("no such file")));
  folder_.Write("empty/other.txt", "");
  EXPECT_THAT(Refused("empty", ChartKind::kFit), HasSubstr("got a folder without fit.csv"));
}

TEST_F(EarlierChartTest, AChartOfAnotherKindIsNamed) {
  EXPECT_THAT(Refused("stability", ChartKind::kFit),
              AllOf(HasSubstr("expected a chart of `luxfit chart --fit`"),
                    HasSubstr("got one of `luxfit chart --stability`")));
  EXPECT_THAT(Refused("forward/chart.csv", ChartKind::kStability),
              AllOf(HasSubstr("chart.csv:1: header: expected a chart of `luxfit chart --stability`"),
                    HasSubstr("got one of `luxfit chart`;")));
  EXPECT_THAT(Refused("fit/fit.csv", ChartKind::kForward), HasSubstr("got one of `luxfit chart --fit`"));
  folder_.Write("readings.csv", "id,lux\na,1\n");
  EXPECT_THAT(Refused("readings.csv", ChartKind::kFit),
              HasSubstr("readings.csv:1: header: expected \"factor,value"));
}

TEST_F(EarlierChartTest, ABrokenFieldIsNamedByItsLine) {
  folder_.Replace("fit/fit.csv", "4.2,0", "four,0");
  try {
    FitPointsOf(Read("fit", ChartKind::kFit));
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("fit.csv:3: processor_time_s: expected a finite number, got \"four\""));
  }
}

TEST_F(EarlierChartTest, AnotherSessionIsRefused) {
  folder_.Write("fit/stages/fit_chart.json",
                R"({"session": "office", "reference": "the fit to all observed elements", "inputs": {}})");
  EXPECT_EQ(Read("fit", ChartKind::kFit).rows.size(), 2U);
  folder_.Replace("fit/stages/fit_chart.json", "office", "hall");
  for (const char* name : {"fit", "fit/fit.csv"}) {
    EXPECT_THAT(Refused(name, ChartKind::kFit),
                AllOf(HasSubstr("fit_chart.json: session: expected \"office\""), HasSubstr("got \"hall\"")));
  }
  folder_.Write("taken_out.csv", kFit);
  EXPECT_EQ(Read("taken_out.csv", ChartKind::kFit).rows.size(), 2U) << "a table alone names no session";
  folder_.Write("fit/stages/fit_chart.json", "[]");
  EXPECT_THAT(Refused("fit", ChartKind::kFit), HasSubstr("expected what `luxfit chart --fit` writes"));
}

TEST_F(EarlierChartTest, ErrorsAgainstAnotherTruthAreRefused) {
  folder_.Write("truth.json", "{}");
  folder_.Write("other.json", "{ }");
  const std::string truth = folder_.Path("truth.json"), other = folder_.Path("other.json");
  const auto write = [&](const std::string& reference, const std::string& inputs) {
    folder_.Write("fit/stages/fit_chart.json", R"({"session": "office", "reference": ")" + reference +
                                                   R"(", "inputs": {)" + inputs + "}}");
  };
  // The same content under another path is the same truth.
  write("moved.json", R"("moved.json": ")" + HashFile(truth) + "\"");
  EXPECT_EQ(Read("fit", ChartKind::kFit, truth).rows.size(), 2U);
  EXPECT_THAT(Refused("fit", ChartKind::kFit, other),
              AllOf(HasSubstr("fit_chart.json: reference: expected errors against " + other),
                    HasSubstr("got errors against moved.json")));
  EXPECT_THAT(Refused("fit", ChartKind::kFit), HasSubstr("what the undegraded session gives"));
  write("the fit to all observed elements", "");
  EXPECT_EQ(Read("fit", ChartKind::kFit).rows.size(), 2U);
  EXPECT_THAT(Refused("fit", ChartKind::kFit, truth), HasSubstr("the fit to all observed elements"));
}

}  // namespace
}  // namespace luxfit
