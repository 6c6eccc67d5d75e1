// `luxfit report` on a small room, run as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/apps/program.h"
#include "tests/support/apps/report_data.h"
#include "tests/support/apps/small_room.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ReportTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    support::FitSmallRoom(*folder_);
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static support::ProgramRun Report(const std::string& options = "") {
    return support::RunProgram("report '" + folder_->Path("out") + "' " + options);
  }

  static TempFolder* folder_;
};
TempFolder* ReportTest::folder_ = nullptr;

TEST_F(ReportTest, IsOneFileThatHoldsTheResult) {
  const support::ProgramRun run = Report();
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("Work plane, state both"));
  const std::string page = folder_->Read("out/report.html");
  EXPECT_LT(page.size(), 10'000'000U);
  const json data = support::ReportDataOf(page);
  EXPECT_EQ(data["result"]["luminaires"].size(), 2U);
  EXPECT_EQ(data["session"], support::kHostileName);
  EXPECT_EQ(data["luminaires"][0]["id"], support::kHostileName);
  EXPECT_EQ(page.find("<b>"), std::string::npos);
  EXPECT_EQ(data["room"]["cells"]["count"], data["room"]["elements"]);
  EXPECT_EQ(data["places"]["planes"][0]["statistics"].size(), 2U);  // one a state
}

// Light adds: the state that has the first luminaire alone at half is what the columns say.
TEST_F(ReportTest, StatisticsAreThoseOfTheReadings) {
  const support::ProgramRun run = Report("--json");
  ASSERT_EQ(run.status, 0) << run.output;
  const json summary =
      json::parse(run.output.substr(run.output.find('{'), run.output.rfind('}') + 1 - run.output.find('{')));
  EXPECT_EQ(summary["state"], "both");
  const json& both = summary["areas"][0]["statistics"][0];
  const json result = json::parse(folder_->Read("out/result.json"));
  double least = 1e9, largest = 0;
  for (const json& reading : result["luxmeter"]) {
    if (reading["state"] != "both") continue;
    least = std::min(least, reading["predicted_lx"].get<double>());
    largest = std::max(largest, reading["predicted_lx"].get<double>());
  }
  // The readings lie within the plane, 5 cm above it.
  EXPECT_GT(both["average_lx"].get<double>(), 0.8 * least);
  EXPECT_LT(both["average_lx"].get<double>(), largest);
  EXPECT_GT(both["average_sigma_lx"].get<double>(), 0);
  EXPECT_TRUE(summary["observers"][0]["ugr"][0].is_number()) << summary["observers"];
}

TEST_F(ReportTest, AreasAreThoseOfTheTargets) {
  folder_->Write("targets.toml",
                 "[[area]]\nid = \"left\"\ntask = \"filing\"\npolygon_m = [[0.5, 0.5], [2, 0.5], [2, 2.5], "
                 "[0.5, 2.5]]\n");
  const support::ProgramRun run = Report("--state half --targets '" + folder_->Path("targets.toml") + "'");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("left, state half"));
  const json data = support::ReportDataOf(folder_->Read("out/report.html"));
  EXPECT_EQ(data["places"]["planes"][0]["average_lx"], 300);
  EXPECT_EQ(data["state"], "half");
  EXPECT_TRUE(data["places"]["observers"].empty());
}

// Energy balance, in closed form: the flux of the luminaires is what floor, walls and ceiling absorb.
TEST_F(ReportTest, FloorWallsAndCeilingAbsorbTheFlux) {
  folder_->Write("floor.toml", "[[area]]\nid = \"floor\"\nheight_m = 0.001\nmargin_m = 0\nspacing_m = 0.2\n");
  const support::ProgramRun run = Report("--json --targets '" + folder_->Path("floor.toml") + "'");
  ASSERT_EQ(run.status, 0) << run.output;
  const json summary =
      json::parse(run.output.substr(run.output.find('{'), run.output.rfind('}') + 1 - run.output.find('{')));
  double absorbed_lm = (1 - 0.3) * 12 * summary["areas"][0]["statistics"][0]["average_lx"].get<double>();
  int walls = 0;
  for (const json& surface : summary["surfaces"]) {
    const json& statistics = surface["statistics"][0];
    if (surface["kind"] == "cylindrical") continue;
    EXPECT_TRUE(surface["required_lx"].is_null());
    const bool is_x = surface["id"].get<std::string>().rfind("Wall x", 0) == 0;
    const double area_m2 = surface["kind"] == "ceiling" ? 12 : 2.5 * (is_x ? 3 : 4);
    absorbed_lm += (1 - 0.6) * area_m2 * statistics["average_lx"].get<double>();
    EXPECT_GT(statistics["average_sigma_lx"].get<double>(), 0);
    ++walls;
  }
  EXPECT_EQ(walls, 5);
  double flux_lm = 0;
  const json result = json::parse(folder_->Read("out/result.json"));
  for (const json& luminaire : result["luminaires"]) flux_lm += luminaire["flux_lm"].get<double>();
  // Points in the middle of cells of up to 0.4 m stand for their means.
  EXPECT_NEAR(absorbed_lm, flux_lm, 0.02 * flux_lm);
}

TEST_F(ReportTest, PowersAreOfLuminairesOfTheResult) {
  folder_->Write("power.toml", "maintenance_factor = 0.8\n[power_w]\nB = 10\n");
  support::ProgramRun run = Report("--targets '" + folder_->Path("power.toml") + "'");
  ASSERT_EQ(run.status, 0) << run.output;
  const json data = support::ReportDataOf(folder_->Read("out/report.html"));
  EXPECT_EQ(data["maintenance_factor"], 0.8);
  EXPECT_EQ(data["power_w"], json::array({nullptr, 10.0}));
  EXPECT_EQ(data["places"]["planes"][0]["average_lx"], 500);  // the default areas stay
  folder_->Write("power.toml", "[power_w]\nC = 10\n");
  run = Report("--targets '" + folder_->Path("power.toml") + "'");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("power.toml:2: power_w.C: expected a luminaire of the result"));
}

// No stage depends on [report], so that a run takes it up without a new fit.
TEST_F(ReportTest, RunTakesUpWhatTheCoverSays) {
  folder_->Write("own.toml", folder_->Read("session.toml"));
  const std::string run = "run '" + folder_->Path("own.toml") + "' -o '" + folder_->Path("run") + "'";
  ASSERT_EQ(support::RunProgram(run).status, 0);
  const json before = json::parse(folder_->Read("run/result.json"));
  folder_->Write("own.toml", folder_->Read("own.toml") + "\n[report]\nclient = \"Example Ltd\"\n");
  EXPECT_THAT(support::RunProgram(run).output, HasSubstr("nothing has changed"));
  const json data = support::ReportDataOf(folder_->Read("run/report.html"));
  EXPECT_EQ(data["details"]["client"], "Example Ltd");
  const json after = json::parse(folder_->Read("run/result.json"));
  EXPECT_EQ(after["luminaires"], before["luminaires"]);
  EXPECT_EQ(support::RunProgram("report '" + folder_->Path("run") + "'").status, 0);
}

TEST_F(ReportTest, BadInputEndsWithStatus2AndWhatToDo) {
  support::ProgramRun run = support::RunProgram("report '" + folder_->Path("nothing") + "'");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("nothing/result.json"));
  run = Report("--state hlaf");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("did you mean \"half\"?"));
  folder_->Write("bad.toml", "[[area]]\nid = \"a\"\nuniformity = 6\n");
  run = Report("--targets '" + folder_->Path("bad.toml") + "'");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("bad.toml:3: area[0].uniformity"));
}

TEST_F(ReportTest, NothingIsWrittenOutsideOut) {
  const auto count = [&] {
    const std::filesystem::recursive_directory_iterator files(folder_->Path("")), end;
    return std::distance(files, end);
  };
  ASSERT_EQ(Report().status, 0);
  const auto before = count();
  ASSERT_EQ(Report().status, 0);
  EXPECT_EQ(count(), before);
}

// The light that was there with all luminaires off stands among the conditions.
TEST(ReportConditions, NameTheAmbientLightThatWasSubtracted) {
  TempFolder folder;
  support::FitSmallRoom(folder);
  std::string session = folder.Read("session.toml");
  session.replace(session.find("[states]\n"), 9, "[states]\noff = {}\n");
  folder.Write("session.toml", session);
  folder.Write("luxmeter.csv", folder.Read("luxmeter.csv") + "P0,0.5,1,0.8,0,0,1,off,2.5\n");
  const std::string out = folder.Path("lit");
  ASSERT_EQ(support::RunProgram("fit '" + folder.Path("session.toml") + "' -o '" + out + "'").status, 0);
  ASSERT_EQ(support::RunProgram("report '" + out + "'").status, 0);
  EXPECT_EQ(support::ReportDataOf(folder.Read("lit/report.html"))["conditions"]["ambient_lx"], 2.5);
}

}  // namespace
}  // namespace luxfit
