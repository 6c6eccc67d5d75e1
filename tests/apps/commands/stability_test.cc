// `luxfit chart --stability`, as a user runs it: a room surveyed by luxmeter, whose lamps are simulated
// nearer and nearer, and whose black walls are raised.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;
using testing::UnorderedElementsAre;

constexpr char kSession[] = R"(name = "bench"

[scene]
mesh = "room.obj"

[scene.albedo]
wall = 0.0

[states]
A = { A = 1.0 }
B = { B = 1.0 }

[[luminaire]]
id = "A"
photometry = "isotropic"
shape = "point"
aim = [0, 0, -1]

[[luminaire]]
id = "B"
photometry = "isotropic"
shape = "point"
aim = [0, 0, -1]

[luxmeter]
readings = "luxmeter.csv"
fit = ["*"]
)";

// Isotropic lamps of 1000 lm at (1, 1, 1.6) and (2.2, 1, 1.6) in a black room of 3 m x 2 m x 2 m; the inverse
// square and cosine law at 24 points of the floor.
class StabilityCommand : public testing::Test {
 protected:
  StabilityCommand() {
    folder_.Write("session.toml", kSession);
    folder_.Write("room.obj",
                  "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nv 0 0 2\nv 3 0 2\nv 3 2 2\nv 0 2 2\n"
                  "usemtl wall\nf 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
    std::ostringstream table;
    table << "id,x_m,y_m,z_m,nx,ny,nz,state,lux\n";
    for (const auto& [state, lamp_x] : {std::pair<std::string, double>{"A", 1}, {"B", 2.2}}) {
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 4; ++j) {
          const double x = 0.3 + 0.48 * i, y = 0.3 + 0.45 * j, z = 0.05, height = 1.6 - z;
          const double r2 = std::pow(x - lamp_x, 2) + std::pow(y - 1, 2) + height * height;
          const double lux = 1000 / (4 * 3.14159265358979323846) * height / std::pow(r2, 1.5);
          table << "R" << i << j << "," << x << "," << y << "," << z << ",0,0,1," << state << "," << lux
                << "\n";
        }
      }
    }
    folder_.Write("luxmeter.csv", table.str());
  }

  support::ProgramRun Run(const std::string& flags, const std::string& out = "out") const {
    return support::RunProgram("chart '" + folder_.Path("session.toml") + "' -o '" + folder_.Path(out) +
                               "' --stability --trials 1 " + flags);
  }

  // Writes the session's luminaires as truth, the second one hung at that height. Returns the flag that names the file.
  std::string TruthFlag(double height_of_b_m) const {
    const json truth = {{"lamps",
                         {{{"id", "A"}, {"position", {1, 1, 1.6}}, {"flux_lm", 1000}},
                          {{"id", "B"}, {"position", {2.2, 1, height_of_b_m}}, {"flux_lm", 1000}}}}};
    folder_.Write("truth.json", truth.dump());
    return "--truth '" + folder_.Path("truth.json") + "'";
  }

  json Artifact() const { return json::parse(folder_.Read("out/stages/stability.json")); }

  int LogLines() const {
    std::ifstream log(folder_.Path("out/stages/stability_trials.jsonl"));
    int lines = 0;
    for (std::string line; std::getline(log, line);) ++lines;
    return lines;
  }

  TempFolder folder_;
};

TEST_F(StabilityCommand, ChartsWhatTheSessionAllowsAndNamesTheRest) {
  const support::ProgramRun run = Run(TruthFlag(1.6));
  ASSERT_EQ(run.status, 0) << run.output;
  const json artifact = Artifact();
  // The readings are exact. The fit ends where nothing moves by 0.5 mm; twice that at 1.55 m is 0.13 % of the light.
  EXPECT_TRUE(artifact["undegraded"]["success"].get<bool>());
  EXPECT_LT(artifact["undegraded"]["worst_position_m"].get<double>(), 1e-3);
  EXPECT_LT(artifact["undegraded"]["worst_flux"].get<double>(), 2e-3);
  ASSERT_EQ(artifact["edges"].size(), 2u);
  EXPECT_EQ(artifact["edges"][0]["degradation"], "luminaires_together");
  EXPECT_EQ(artifact["edges"][1]["degradation"], "albedo_raised");
  // The session has readings alone: what degrades photos, their views, states, tags or furniture has no object.
  std::map<std::string, std::string> skipped;
  for (const json& one : artifact["skipped"])
    skipped[one["degradation"].get<std::string>()] = one["because"].get<std::string>();
  EXPECT_THAT(skipped,
              UnorderedElementsAre(
                  Pair("noise", "the session has no photos"), Pair("exposure", "the session has no photos"),
                  Pair("views_dropped", "fewer than two views are observed"),
                  Pair("states_dropped", "fewer than two states are observed"),
                  Pair("tags_moved", "no surveyed tags are used"),
                  Pair("faces_removed", "the session has no photos, or its mesh no furniture")));
  EXPECT_EQ(artifact["skipped"].size(), skipped.size()) << "none is named twice";
  EXPECT_THAT(artifact["simulated"].get<std::string>(), HasSubstr("light tracer"));
  EXPECT_THAT(folder_.Read("out/stability_albedo_raised.svg"), HasSubstr("reflectances raised"));
  EXPECT_FALSE(std::filesystem::exists(folder_.Path("out/stability_noise.svg")));
  // Lamps lit one by one do not mind how near they hang: the first level of both is good.
  std::istringstream csv(folder_.Read("out/stability.csv"));
  std::string header, row;
  std::getline(csv, header);
  EXPECT_THAT(header, testing::StartsWith("degradation,level,unit,trials,success_percent"));
  std::getline(csv, row);
  EXPECT_THAT(row, testing::StartsWith("luminaires_together,1,m,1,100,0,"));
  EXPECT_THAT(run.output, HasSubstr("of 10"));
  EXPECT_THAT(run.output, HasSubstr("left out: the session has no photos"));
}

TEST_F(StabilityCommand, IsDeterministicBySeed) {
  ASSERT_EQ(Run("--only luminaires_together", "first").status, 0);
  ASSERT_EQ(Run("--only luminaires_together", "second").status, 0);
  ASSERT_EQ(Run("--only luminaires_together --seed 2", "other").status, 0);
  EXPECT_EQ(folder_.Read("first/stability.csv"), folder_.Read("second/stability.csv"));
  EXPECT_NE(folder_.Read("first/stability.csv"), folder_.Read("other/stability.csv"));
}

TEST_F(StabilityCommand, GoesOnWhereItWasStopped) {
  ASSERT_EQ(Run("--only luminaires_together").status, 0);
  const std::string csv = folder_.Read("out/stability.csv"),
                    log = folder_.Read("out/stages/stability_trials.jsonl");
  ASSERT_EQ(LogLines(), 5);
  // As a program leaves it that is killed while it writes its third line.
  size_t end = 0;
  for (int line = 0; line < 2; ++line) end = log.find('\n', end) + 1;
  folder_.Write("out/stages/stability_trials.jsonl", log.substr(0, end + 40));
  const support::ProgramRun run = Run("--only luminaires_together");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("2 of 5 trials were done earlier"));
  EXPECT_EQ(LogLines(), 6);  // the torn line stays and counts as nothing
  EXPECT_EQ(folder_.Read("out/stability.csv"), csv);
  // All done; other inputs start anew.
  EXPECT_THAT(Run("--only luminaires_together").output, HasSubstr("5 of 5 trials were done earlier"));
  EXPECT_THAT(Run("--only luminaires_together --seed 5").output, Not(HasSubstr("done earlier")));
}

TEST_F(StabilityCommand, TakesTheTruthFromAFile) {
  const support::ProgramRun run = Run("--only luminaires_together " + TruthFlag(1.9));
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_FALSE(Artifact()["undegraded"]["success"].get<bool>());  // B hangs 0.3 m higher than that
  EXPECT_NEAR(Artifact()["undegraded"]["worst_position_m"].get<double>(), 0.3, 0.01);
}

TEST_F(StabilityCommand, ChartsTheWholeFit) {
  const support::ProgramRun run = support::RunProgram("chart '" + folder_.Path("session.toml") + "' -o '" +
                                                      folder_.Path("out") + "' --fit --json 2>/dev/null");
  ASSERT_EQ(run.status, 0) << run.output;
  const json artifact = json::parse(run.output);
  ASSERT_EQ(artifact["points"].size(), 3u);  // all readings, then one luminaire and both
  EXPECT_EQ(artifact["points"][0]["position_mm"], 0);
  EXPECT_EQ(artifact["points"][1]["luminaires"], 1);
  EXPECT_LT(artifact["points"][1]["position_mm"].get<double>(), 1);
  EXPECT_TRUE(artifact["slopes"].contains("luminaires"));
  EXPECT_THAT(folder_.Read("out/fit.csv"), testing::StartsWith("factor,value,patches,photos,luminaires"));
  EXPECT_THAT(folder_.Read("out/fit_cost.svg"), HasSubstr("slope"));
}

TEST_F(StabilityCommand, DrawsAnEarlierFitChartInTheSamePictures) {
  const std::string chart = "chart '" + folder_.Path("session.toml") + "' --fit ";
  ASSERT_EQ(support::RunProgram(chart + "-o '" + folder_.Path("out") + "'").status, 0);
  EXPECT_THAT(folder_.Read("out/fit_cost.svg"), Not(HasSubstr("stroke-dasharray")));
  const support::ProgramRun run =
      support::RunProgram(chart + "-o '" + folder_.Path("again") + "' --before '" + folder_.Path("out") +
                          "' --before-name 0.1.0 --after-name 'a < b'");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(folder_.Read("again/fit_cost.svg"),
              AllOf(HasSubstr("stroke-dasharray"), HasSubstr(">0.1.0<"), HasSubstr(">a &lt; b<")));
  const json artifact = json::parse(folder_.Read("again/stages/fit_chart.json"));
  EXPECT_TRUE(artifact["inputs"].contains(folder_.Path("out/fit.csv")));
}

TEST_F(StabilityCommand, DrawsAnEarlierStabilityChartInTheSamePictures) {
  ASSERT_EQ(Run("--only luminaires_together").status, 0);
  const std::string csv = folder_.Read("out/stability.csv");
  const std::string before = "--only luminaires_together --before '" + folder_.Path("out") + "'";
  const support::ProgramRun run = Run(before);  // into the folder of the earlier chart
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("5 of 5 trials were done earlier")) << "no trial depends on it";
  EXPECT_EQ(folder_.Read("out/stability.csv"), csv);
  EXPECT_THAT(folder_.Read("out/stability_luminaires_together.svg"),
              AllOf(HasSubstr("stroke-dasharray"), HasSubstr(">before<"), HasSubstr(">after<")));
  EXPECT_TRUE(Artifact()["inputs"].contains(folder_.Path("out/stability.csv")));
  // Errors against the undegraded fit do not compare with errors against a truth.
  const support::ProgramRun other = Run(before + " " + TruthFlag(1.6));
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.output, HasSubstr("stability.json: reference: expected errors against"));
}

TEST_F(StabilityCommand, SaysWhatIsWrong) {
  support::ProgramRun run = Run("--only noize");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("did you mean \"noise\""));
  EXPECT_EQ(Run("--elements 0").status, 2);
  run = Run("--truth '" + folder_.Path("none.json") + "'");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("none.json"));
  folder_.Write("odd.json", "{\"lamps\": [{\"id\": \"A\"}]}");
  run = Run("--truth '" + folder_.Path("odd.json") + "'");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("lamps: expected"));
  run = Run("--before '" + folder_.Path("none") + "'");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output,
              HasSubstr(folder_.Path("none") + ": expected a chart of `luxfit chart --stability`"));
  run = support::RunProgram("chart '" + folder_.Path("session.toml") + "' -o '" + folder_.Path("out") +
                            "' --trials 2");
  EXPECT_EQ(run.status, 2);  // --trials without --stability
  for (const char* flags : {"--elements 10", "--stability --fit", "--fit --before-name old"}) {
    EXPECT_EQ(support::RunProgram("chart '" + folder_.Path("session.toml") + "' -o '" + folder_.Path("out") +
                                  "' " + flags)
                  .status,
              2);
  }
}

}  // namespace
}  // namespace luxfit
