// The office that an independent renderer photographed, its session with several mistakes at once: `luxfit fit --apply` ends where
// the right session does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/apps/office_copy.h"
#include "tests/support/apps/program.h"

namespace luxfit {
namespace {

using nlohmann::json;
using support::RunProgram;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

using Fields = std::vector<std::string>;

class AppliedCorrections : public testing::Test {
 protected:
  void ShiftMesh(double x_m) {
    office_.MapMesh(
        [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p + Eigen::Vector3d(x_m, 0, 0); });
  }

  void ExchangePhotos(const std::string& view) {
    office_.ChangeRows("office/photos.csv", [&](Fields& row) {
      if (row[2] == view && (row[3] == "A" || row[3] == "B")) row[3] = row[3] == "A" ? "B" : "A";
      return true;
    });
  }

  void ExchangeAxesOfReadings() {
    office_.ChangeRows("office/luxmeter.csv", [](Fields& row) {
      std::swap(row[1], row[2]);
      return true;
    });
  }

  static std::vector<std::string> CodesOf(const json& result) {
    std::vector<std::string> codes;
    for (const json& w : result["warnings"]) codes.push_back(w["code"]);
    return codes;
  }

  // The mean illuminance of the work plane in each state, by the report.
  std::vector<double> AverageLx() const {
    const support::ProgramRun run = RunProgram("report '" + office_.Out() + "' --json 2> /dev/null");
    EXPECT_EQ(run.status, 0) << run.output;
    std::vector<double> average_lx;
    const json report = json::parse(run.output);
    for (const json& of_state : report["areas"][0]["statistics"])
      average_lx.push_back(of_state["average_lx"]);
    return average_lx;
  }

  // The same light, to what rounding changes. A mesh that is moved back, whose corners are rounded otherwise, moves a
  // luminaire by 0.28 mm, a dimming value of 0.30001 for 0.3 by 0.005 mm. The sigma of a position is 3 mm.
  static void ExpectSameLight(const json& right, const json& found) {
    ASSERT_EQ(right["luminaires"].size(), found["luminaires"].size());
    for (size_t k = 0; k < right["luminaires"].size(); ++k) {
      const json &a = right["luminaires"][k], &b = found["luminaires"][k];
      EXPECT_NEAR(b["flux_lm"].get<double>() / a["flux_lm"].get<double>(), 1, 1e-3);
      for (size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(b["position_m"][axis].get<double>(), a["position_m"][axis].get<double>(), 5e-4);
    }
    ASSERT_EQ(right["luxmeter"].size(), found["luxmeter"].size());
    for (size_t i = 0; i < right["luxmeter"].size(); ++i)
      EXPECT_NEAR(found["luxmeter"][i]["predicted_lx"].get<double>() /
                      right["luxmeter"][i]["predicted_lx"].get<double>(),
                  1, 1e-3);
  }

  support::OfficeCopy office_;
};

TEST_F(AppliedCorrections, FourMistakesAtOnceEndWhereTheRightSessionDoes) {
  const json right = office_.ResultOf("fit", 0, "--apply");
  EXPECT_FALSE(right.contains("corrections"));
  const std::vector<double> reported_right = AverageLx();
  ShiftMesh(0.1);
  ExchangePhotos("v03");
  office_.Replace("office/session.toml", "A = 0.3", "A = 1.0");
  ExchangeAxesOfReadings();
  const std::string session = office_.Read("office/session.toml");

  const json found = office_.ResultOf("fit", 0, "--apply");
  EXPECT_EQ(found["status"], "done");
  EXPECT_EQ(office_.Read("office/session.toml"), session);
  for (const char* part : {"mesh", "photos", "states", "readings"})
    EXPECT_TRUE(found["corrections"].contains(part)) << part;
  EXPECT_NEAR(found["corrections"]["states"]["evening"]["A"].get<double>(), 0.3, 1e-3);
  for (const char* as_given : {"mesh_as_if", "photos_as_if", "states_as_if", "readings_as_if"})
    EXPECT_THAT(CodesOf(found), Not(Contains(as_given)));
  EXPECT_THAT(found["choices"].dump(), HasSubstr("A was at 0.30 in state evening"));
  ExpectSameLight(right, found);

  const support::ProgramRun again = office_.Run("fit", "--apply");
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.output, HasSubstr("nothing has changed"));
  // Whoever reads the session of the run again reads the corrected one.
  const std::vector<double> reported = AverageLx();
  ASSERT_EQ(reported.size(), 6u);
  for (size_t s = 0; s < reported.size(); ++s) EXPECT_NEAR(reported[s] / reported_right[s], 1, 1e-3);
}

TEST_F(AppliedCorrections, WhatSeveralExplanationsExplainIsLeftAlone) {
  // Heights 0.75 m too high: the meter was lower, or lay on the desks, which the readings do not tell apart.
  office_.ChangeRows("office/luxmeter.csv", [](Fields& row) {
    row[3] = fmt::format("{}", std::stod(row[3]) + 0.75);
    return true;
  });
  const json result = office_.ResultOf("fit", 1, "--apply");
  EXPECT_FALSE(result.contains("corrections"));
  EXPECT_THAT(CodesOf(result), Contains("readings_as_if"));
}

}  // namespace
}  // namespace luxfit
