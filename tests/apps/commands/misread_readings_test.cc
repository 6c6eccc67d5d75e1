// `luxfit fit` and `luxfit check` on readings of given luminaires in a small room, read wrongly. `simulate` gives the
// right readings: what is tested is that commands name the mistake (the comparison itself: explain_readings_test).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr char kMisreadRoom[] = R"(name = "small"

[scene]
size = [4, 3, 2.5]

[scene.albedo]
floor = 0.3
ceiling = 0.7
"wall 1" = 0.6
"wall 2" = 0.6
"wall 3" = 0.6
"wall 4" = 0.6

[states]
both = { A = 1.0, B = 1.0 }
A = { A = 1.0 }

[[luminaire]]
id = "A"
photometry = "lambertian"
shape = "disc"
size_m = [0.4]
position_m = [1.0, 1.2, 2.4]
position_sigma_m = 0
flux_lm = 1000
flux_sigma_lm = 0

[[luminaire]]
id = "B"
photometry = "lambertian"
shape = "point"
position_m = [3.0, 1.7, 2.4]
position_sigma_m = 0
flux_lm = 700
flux_sigma_lm = 0

[luxmeter]
readings = "luxmeter.csv"
)";

struct Row {
  std::string id, state;
  double x_m, y_m, lx;
};

class MisreadReadings : public testing::Test {
 protected:
  MisreadReadings() {
    const std::vector<std::pair<double, double>> places{{0.5, 1}, {1.5, 0.8}, {2.5, 1.2},
                                                        {2.9, 2}, {0.7, 2},   {1.6, 2.2}};
    for (const char* state : {"both", "A"}) {
      for (size_t i = 0; i < places.size(); ++i)
        rows_.push_back({fmt::format("P{}", i), state, places[i].first, places[i].second, 0});
    }
    Write(rows_, "");
    const support::ProgramRun run = support::RunProgram(
        fmt::format("simulate '{}' -o '{}'", folder_.Path("session.toml"), folder_.Path("simulated")));
    EXPECT_EQ(run.status, 0) << run.output;
    std::istringstream simulated(folder_.Read("simulated/illuminance.csv"));
    std::string line;
    std::getline(simulated, line);
    for (Row& row : rows_) {
      std::getline(simulated, line);
      row.lx = std::stod(line.substr(line.find(',', line.find(',') + 1) + 1));
    }
  }

  void Write(const std::vector<Row>& rows, const std::string& luxmeter) const {
    std::string table = "id,x_m,y_m,z_m,nx,ny,nz,state,lux\n";
    for (const Row& r : rows)
      table += fmt::format("{},{},{},0.8,0,0,1,{},{}\n", r.id, r.x_m, r.y_m, r.state, r.lx);
    folder_.Write("luxmeter.csv", table);
    folder_.Write("session.toml", kMisreadRoom + luxmeter);
  }

  // Fits one reading beside the given luminaires, with a mistake in each row of the table.
  json Fit(const std::function<void(Row&)>& mistake, int status) const {
    std::vector<Row> rows = rows_;
    for (Row& row : rows) mistake(row);
    Write(rows, "fit = [\"P1@A\"]\n");
    const support::ProgramRun run = support::RunProgram(
        fmt::format("fit '{}' -o '{}'", folder_.Path("session.toml"), folder_.Path("out")));
    EXPECT_EQ(run.status, status) << run.output;
    return json::parse(folder_.Read("out/result.json"));
  }

  support::ProgramRun Check(const std::string& flags = "") const {
    return support::RunProgram(fmt::format("check '{}' {}", folder_.Path("out"), flags));
  }

  TempFolder folder_;
  std::vector<Row> rows_;
};

TEST_F(MisreadReadings, RightOnesAreLeftAlone) {
  const json result = Fit([](Row&) {}, 0);
  EXPECT_FALSE(result["check"].contains("explained"));
  EXPECT_THAT(Check().output, Not(HasSubstr("look as if")));
}

TEST_F(MisreadReadings, TheMistakeIsAWarningAndAVerdictOfTheCheck) {
  const json result = Fit([](Row& row) { std::swap(row.x_m, row.y_m); }, 1);
  EXPECT_EQ(result["status_because"][0], "readings_as_if");
  ASSERT_TRUE(result["check"].contains("explained")) << result["warnings"].dump(1);
  const json& explained = result["check"]["explained"];
  ASSERT_EQ(explained["by"].size(), 1u) << explained;
  EXPECT_EQ(explained["by"][0]["as_if"], "x and y were exchanged");
  // Two solutions of one room differ by this much, through their luminaires and patches.
  EXPECT_LT(explained["by"][0]["rms_percent"].get<double>(), 1.5);
  EXPECT_GT(explained["rms_percent_as_given"].get<double>(), 10);
  const support::ProgramRun run = Check();
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, HasSubstr("the readings look as if x and y were exchanged: so read, they are"));
  EXPECT_THAT(run.output, HasSubstr("remedy: compare x_m and y_m of the readings with the axes of the mesh"));
  EXPECT_EQ(json::parse(Check("--json").output)["check"]["explained"], explained);
}

TEST_F(MisreadReadings, FootCandlesContradictGivenFluxes) {
  const json result = Fit([](Row& row) { row.lx /= 10.764; }, 1);
  ASSERT_TRUE(result["check"].contains("explained")) << result["warnings"].dump(1);
  EXPECT_THAT(result["check"]["explained"]["message"].get<std::string>(),
              HasSubstr("all 12 readings were 10.8 times too low, as in foot-candles"));
}

TEST_F(MisreadReadings, OneReadingOffIsNamedAlone) {
  const json result = Fit([](Row& row) { row.lx *= row.id == "P3" && row.state == "A" ? 10 : 1; }, 1);
  EXPECT_FALSE(result["check"].contains("explained"));
  EXPECT_THAT(Check().output, HasSubstr("it is off as by a decimal point, or another range of the meter"));
}

}  // namespace
}  // namespace luxfit
