// `luxfit run` on fixtures/openplan, which an independent renderer made: twenty like panels in four switched rows, six views.
// Limits are 1.5 times what was measured (docs/accuracy.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
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

}  // namespace
}  // namespace luxfit
