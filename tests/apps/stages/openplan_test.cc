// `luxfit run` on fixtures/openplan, which an independent renderer made: twenty like panels in four switched rows, six views.
// Limits are 1.5 times what was measured (docs/accuracy.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/paths.h"
#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"
#include "tests/support/truth_comparison.h"

namespace luxfit {
namespace {

using nlohmann::json;

std::vector<std::string> MessagesOf(const json& result, const std::string& code) {
  std::vector<std::string> messages;
  for (const json& warning : result["warnings"])
    if (warning["code"] == code) messages.push_back(warning["message"]);
  return messages;
}

TEST(OpenPlan, TwentyPanelsAreFoundAndTheAgedOnesNamed) {
  const TempFolder folder;
  const std::string fixture = std::string(LUXFIT_FIXTURES) + "/openplan";
  const support::ProgramRun run =
      support::RunProgram("run " + fixture + "/session.toml --budget 900 -o " + folder.Path("out"));
  EXPECT_EQ(run.status, 0) << run.output;
  const json result = json::parse(folder.Read("out/result.json"));
  const TruthComparison errors =
      CompareWithTruth(result, json::parse(std::ifstream(fixture + "/truth.json")));
  const double readings_percent = result["summary"]["mean_abs_error_percent"];
  std::printf("worst position %.2f mm, worst flux %.2f %%, readings %.2f %%\n", errors.worst_position_mm,
              errors.worst_flux_percent, readings_percent);
  EXPECT_EQ(errors.luminaires_missing, 0);
  EXPECT_LT(errors.worst_position_mm, 14);    // 9.5 mm
  EXPECT_LT(errors.worst_flux_percent, 2.7);  // 1.76 %
  EXPECT_LT(readings_percent, 2);             // 1.29 %
  EXPECT_THAT(MessagesOf(result, "flux_deviates"),
              testing::ElementsAre(testing::StartsWith("P23 gives"), testing::StartsWith("P45 gives")));
}

// Nobody says how many panels a row has.
TEST(OpenPlan, PanelsOfSwitchedRowsAreCounted) {
  const TempFolder folder;
  const std::filesystem::path fixture = std::filesystem::path(LUXFIT_FIXTURES) / "openplan";
  for (const auto& entry : std::filesystem::directory_iterator(fixture))
    std::filesystem::create_symlink(entry.path(), folder.Path(entry.path().filename().string()));
  std::string text = folder.Read("session.toml");
  const size_t from = text.find("[states]"), to = text.find("[luxmeter]");
  text = text.substr(0, from) +
         "[groups]\nrow1 = \"estimate\"\nrow2 = \"estimate\"\nrow3 = \"estimate\"\nrow4 = "
         "\"estimate\"\n[states]\n"
         "row1 = { row1 = 1 }\nrow2 = { row2 = 1 }\nrow3 = { row3 = 1 }\nrow4 = { row4 = 1 }\n"
         "all = { row1 = 1, row2 = 1, row3 = 1, row4 = 1 }\n" +
         text.substr(to);
  std::filesystem::remove(folder.Path("session.toml"));
  folder.Write("session.toml", text);
  const support::ProgramRun run =
      support::RunProgram("fit " + folder.Path("session.toml") + " --budget 900 -o " + folder.Path("out"));
  EXPECT_EQ(run.status, 0) << run.output;
  const json result = json::parse(folder.Read("out/result.json"));
  ASSERT_EQ(result["luminaires"].size(), 20U);
  EXPECT_EQ(result["luminaires"][5]["id"], "row2_1");
  // Their names are not those of the truth: the nearest one is it.
  const json truth = json::parse(std::ifstream(fixture / "truth.json"));
  for (const json& lamp : truth["lamps"]) {
    double nearest_m = 1e9, flux_lm = 0;
    for (const json& luminaire : result["luminaires"]) {
      double square_m2 = 0;
      for (size_t axis = 0; axis < 3; ++axis)
        square_m2 +=
            std::pow(luminaire["position_m"][axis].get<double>() - lamp["position"][axis].get<double>(), 2);
      if (std::sqrt(square_m2) >= nearest_m) continue;
      nearest_m = std::sqrt(square_m2);
      flux_lm = luminaire["flux_lm"].get<double>();
    }
    EXPECT_LT(1000 * nearest_m, 14) << lamp["id"];
    EXPECT_NEAR(flux_lm / lamp["flux_lm"].get<double>(), 1, 0.027) << lamp["id"];
  }
}

}  // namespace
}  // namespace luxfit
