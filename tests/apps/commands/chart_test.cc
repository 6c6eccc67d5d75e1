// `luxfit chart`, as a user runs it: what it writes, and what it says of bad input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using testing::HasSubstr;

constexpr char kSession[] = R"(name = "box & <bench>"

[scene]
mesh = "room.obj"

[scene.albedo]
wall = 0.5

[states]
one = { A = 1.0 }

[[luminaire]]
id = "A"
photometry = "lambertian"
shape = "disc"
size_m = [0.2]
position_m = [1, 1, 1.9]
flux_lm = 1000
)";

using Row = std::map<std::string, std::string>;

class ChartCommandTest : public testing::Test {
 protected:
  ChartCommandTest() {
    folder_.Write("session.toml", kSession);
    folder_.Write("room.obj",
                  "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nv 0 0 2\nv 3 0 2\nv 3 2 2\nv 0 2 2\n"
                  "usemtl wall\nf 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
  }

  support::ProgramRun Run(const std::string& flags) const {
    return support::RunProgram("chart '" + folder_.Path("session.toml") + "' -o '" + folder_.Path("out") +
                               "' " + flags);
  }

  std::vector<Row> Rows() const {
    std::istringstream csv(folder_.Read("out/chart.csv"));
    std::vector<std::string> header;
    std::vector<Row> rows;
    for (std::string line; std::getline(csv, line);) {
      std::vector<std::string> cells;
      std::istringstream in(line);
      for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
      if (header.empty()) {
        header = cells;
        continue;
      }
      EXPECT_EQ(cells.size(), header.size()) << line;
      rows.emplace_back();
      for (size_t i = 0; i < std::min(cells.size(), header.size()); ++i) rows.back()[header[i]] = cells[i];
    }
    return rows;
  }

  TempFolder folder_;
};

// Elements open and close in order, and nothing is left over: what an XML parser asks first.
bool IsWellFormed(const std::string& xml) {
  std::vector<std::string> open;
  for (size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const size_t end = xml.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag.find('<') != std::string::npos || std::count(tag.begin(), tag.end(), '"') % 2 != 0) return false;
    if (tag[0] == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(tag.substr(0, tag.find(' ')));
    }
  }
  for (size_t at = xml.find('&'); at != std::string::npos; at = xml.find('&', at + 1)) {
    if (xml.find(';', at) > at + 6) return false;
  }
  return open.empty();
}

TEST_F(ChartCommandTest, WritesTableChartAndArtifact) {
  const support::ProgramRun run = Run("--budget 12 --json 2>/dev/null");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(folder_.Read("out/chart.csv"),
              testing::StartsWith("factor,method,rays,patch_size_m,element_size_m,adaptive,bounces,solver,"
                                  "patches,time_s,error_percent,"
                                  "estimated_error_percent,on_front,automatic\n"));
  const std::vector<Row> rows = Rows();
  std::map<std::string, int> by_factor;
  int automatic = 0;
  for (const Row& row : rows) {
    ++by_factor[row.at("factor")];
    automatic += row.at("automatic") == "1";
    EXPECT_GT(std::stod(row.at("time_s")), 0);
    EXPECT_GE(std::stod(row.at("error_percent")), 0);
  }
  EXPECT_EQ(automatic, 1);
  EXPECT_EQ(by_factor["solver"], 7);
  EXPECT_EQ(by_factor["bounces"], 9);
  // On a busy machine the budget may end before some: then they are listed as skipped.
  const nlohmann::json artifact = nlohmann::json::parse(folder_.Read("out/stages/chart.json"));
  for (const auto& skipped : artifact["skipped"]) ++by_factor[skipped["factor"].get<std::string>()];
  for (const char* factor : {"automatic", "asked_error", "method", "rays", "patch_size", "grid"})
    EXPECT_GE(by_factor[factor], 1) << factor;
  // Direct light alone leaves half of the light out; all bounces do not.
  const auto direct =
      std::find_if(rows.begin(), rows.end(), [](const Row& r) { return r.at("bounces") == "0"; });
  EXPECT_GT(std::stod(direct->at("error_percent")), 20);
  EXPECT_LT(std::stod(rows.front().at("error_percent")),
            1 + 0.5);  // what was asked, and the reference's noise

  EXPECT_EQ(nlohmann::json::parse(run.output), artifact);
  EXPECT_EQ(artifact["format"], "luxfit-chart-1");
  for (const char* key : {"luxfit_version", "command", "inputs", "session", "machine", "reference",
                          "automatic", "front", "skipped", "choices", "warnings", "timing_s"})
    EXPECT_TRUE(artifact.contains(key)) << key;
  EXPECT_EQ(artifact["points"], rows.size());
  EXPECT_GT(artifact["sensors"], 10) << "no readings: a work plane";

  const std::string svg = folder_.Read("out/chart.svg");
  EXPECT_TRUE(IsWellFormed(svg));
  EXPECT_THAT(svg, testing::AllOf(HasSubstr("box &amp; &lt;bench&gt;"), HasSubstr("automatic:"),
                                  HasSubstr("Pareto front"), HasSubstr("time for the whole prediction, s")));
}

TEST_F(ChartCommandTest, TheFrontIsWhatNothingBeats) {
  ASSERT_EQ(Run("--budget 2").status, 0);
  const std::vector<Row> rows = Rows();
  int front = 0;
  for (const Row& row : rows) {
    const double time_s = std::stod(row.at("time_s")), error = std::stod(row.at("error_percent"));
    // By more than the hundredth that counts as the same, and the digits written, in both; in one at least.
    const auto is_beaten = [&](double time_factor, double error_factor) {
      return std::any_of(rows.begin(), rows.end(), [&](const Row& other) {
        return &other != &row && std::stod(other.at("time_s")) < time_factor * time_s &&
               std::stod(other.at("error_percent")) < error_factor * error;
      });
    };
    front += row.at("on_front") == "1";
    if (row.at("on_front") == "1") {
      EXPECT_FALSE(is_beaten(0.98, 0.98));
    } else {
      EXPECT_TRUE(is_beaten(1.02, 0.995) || is_beaten(0.995, 1.02));
    }
  }
  EXPECT_GE(front, 1);  // alone where the fastest is the most accurate too
}

TEST_F(ChartCommandTest, ABudgetThatIsTooShortIsSaid) {
  const support::ProgramRun run = Run("--budget 0.2 --json 2>/dev/null");
  ASSERT_EQ(run.status, 0) << run.output;
  const nlohmann::json artifact = nlohmann::json::parse(run.output);
  ASSERT_FALSE(artifact["skipped"].empty());
  EXPECT_GT(artifact["skipped"][0]["expected_s"].get<double>(), 0);
  EXPECT_FALSE(artifact["skipped"][0]["method"].get<std::string>().empty());
}

TEST_F(ChartCommandTest, TakesWhatAnEarlierFitFound) {
  folder_.Replace("session.toml", "photometry = \"lambertian\"", "photometry = \"auto\"");
  folder_.Replace("session.toml", "flux_lm = 1000\n", "");
  folder_.Replace("session.toml", "wall = 0.5", "");
  support::ProgramRun run = Run("--budget 1");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("--result"));
  folder_.Write("result.json",
                R"({"format": "luxfit-result-1", "luminaires": [{"id": "A", "position_m": [1, 1, 1.9],
    "aim": [0, 0, -1], "photometry": "lambertian", "shape": "disc", "size_m": [0.2], "flux_lm": 1000}],
    "materials": [{"name": "wall", "albedo": 0.5, "albedo_rgb": [0.5, 0.4, 0.3]}]})");
  run = Run("--budget 1 --result '" + folder_.Path("result.json") + "'");
  EXPECT_EQ(run.status, 0) << run.output;
  folder_.Replace("result.json", "\"flux_lm\": 1000", "\"flux_lm\": null");
  run = Run("--budget 1 --result '" + folder_.Path("result.json") + "'");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("expected fluxes in lm"));
}

TEST_F(ChartCommandTest, DrawsAnEarlierChartInTheSamePicture) {
  ASSERT_EQ(Run("--budget 1").status, 0);
  const std::string earlier = " --before '" + folder_.Path("out/chart.csv") + "'";
  support::ProgramRun run = Run("--budget 1 --before-name old" + earlier);
  ASSERT_EQ(run.status, 0) << run.output;
  const std::string svg = folder_.Read("out/chart.svg");
  EXPECT_TRUE(IsWellFormed(svg));
  EXPECT_THAT(svg, testing::AllOf(HasSubstr(">old<"), HasSubstr(">after<"), HasSubstr("automatic: ")));
  EXPECT_EQ(Run("--budget 1 --before-name ''" + earlier).status, 2);
  EXPECT_EQ(Run("--budget 1 --before-name a_name_that_the_legend_cannot_hold" + earlier).status, 2);
  run = Run("--fit" + earlier);
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("got one of `luxfit chart`; give a chart of the same kind"));
  folder_.Replace("session.toml", "box & <bench>", "another");
  run = Run("--budget 1" + earlier);
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("chart.json: session: expected \"another\""));
}

TEST_F(ChartCommandTest, SaysWhatIsWrong) {
  EXPECT_EQ(Run("--budget 0").status, 2);
  EXPECT_EQ(Run("--error -1").status, 2);
  EXPECT_THAT(Run("--result none.json").output, HasSubstr("none.json: expected a readable file"));
  folder_.Write("other.json", "{}");
  const support::ProgramRun run = Run("--result '" + folder_.Path("other.json") + "'");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("format: expected \"luxfit-result-1\""));
  folder_.Replace("session.toml", "flux_lm = 1000\n", "");
  EXPECT_THAT(Run("--budget 1").output, HasSubstr("luminaire[0].flux_lm: expected a flux"));
}

}  // namespace
}  // namespace luxfit
