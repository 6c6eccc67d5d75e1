// `luxfit advise` on a small room that was fitted to readings: what it advises, and whether that holds once it is done.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/apps/program.h"
#include "tests/support/apps/small_room.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class AdviseSmallRoom : public testing::Test {
 protected:
  void SetUp() override { support::FitSmallRoom(folder_); }

  void FitTo(const std::string& readings, int status = 0) {
    folder_.Write("session.toml",
                  support::SmallRoomSession(support::SmallRoomLuminaires(""), "fit = [" + readings + "]\n"));
    const support::ProgramRun fitted =
        support::RunProgram("fit '" + folder_.Path("session.toml") + "' -o '" + folder_.Path("out") + "'");
    ASSERT_EQ(fitted.status, status) << fitted.output;
  }

  support::ProgramRun Advise(const std::string& options) const {
    return support::RunProgram("advise '" + folder_.Path("out") + "' " + options);
  }

  json Advice(const std::string& options) const {
    const support::ProgramRun run = Advise(options);
    EXPECT_EQ(run.status, 0) << run.output;
    return json::parse(folder_.Read("out/advise.json"));
  }

  double FluxSigmaPercent(const std::string& luminaire) const {
    const json result = json::parse(folder_.Read("out/result.json"));
    for (const json& l : result["luminaires"]) {
      if (l["id"] == luminaire) return 100 * l["flux_sigma_lm"].get<double>() / l["flux_lm"].get<double>();
    }
    return -1;
  }

  TempFolder folder_;
};

TEST_F(AdviseSmallRoom, WhatIsAdvisedComesTrue) {
  FitTo(R"("P0@both", "P3@both", "P0@half")");
  const json advice = Advice("--readings '" + folder_.Path("luxmeter.csv") + "' --of flux --top 1");
  ASSERT_EQ(advice["advice"].size(), 1u);
  const json& step = advice["advice"][0];
  EXPECT_EQ(step["kind"], "reading");
  const std::string reading = step["id"].get<std::string>() + "@" + step["state"].get<std::string>();
  EXPECT_NE(reading, "P0@both") << "was used";
  EXPECT_NE(reading, "P3@both") << "was used";
  FitTo(R"("P0@both", "P3@both", "P0@half", ")" + reading + "\"");
  for (const json& change : step["changes"]) {
    const double before = change["sigma_before_percent"], predicted = change["sigma_after_percent"];
    const double after = FluxSigmaPercent(change["of"]);
    std::printf("flux: %.2f %%, predicted %.2f %%, then %.2f %%\n", before, predicted, after);
    // All rows are readings, whose sigmas the fit takes as given: both are the same algebra but for the model's error.
    EXPECT_NEAR(after, predicted, 0.1 * predicted);
  }
  EXPECT_LT(step["helps"]["sigma_after_percent"].get<double>(),
            0.9 * step["helps"]["sigma_before_percent"].get<double>());
}

TEST_F(AdviseSmallRoom, WhatIsNotDeterminedIsSaid) {
  FitTo(R"("P0@both", "P3@both")", 1);  // two readings for two fluxes and an exponent
  const support::ProgramRun run = Advise("--readings '" + folder_.Path("luxmeter.csv") + "' --of flux");
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("not determined -> "));
  const json advice = json::parse(folder_.Read("out/advise.json"));
  EXPECT_TRUE(advice["now"][0]["sigma_before_percent"].is_null());
  EXPECT_TRUE(advice["advice"].back()["changes"][0]["sigma_after_percent"].is_number());
}

// B is on in no reading that the fit has. Its flux is null, as in a result that knows it no better than to a factor of e.
TEST_F(AdviseSmallRoom, ALuminaireWithoutAFluxIsReadFirst) {
  FitTo(R"("P0@half", "P3@half")", 1);
  json result = json::parse(folder_.Read("out/result.json"));
  result["luminaires"][1]["flux_lm"] = result["luminaires"][1]["flux_sigma_lm"] = nullptr;
  folder_.Write("out/result.json", result.dump());
  const json advice = Advice("--readings '" + folder_.Path("luxmeter.csv") + "' --top 1");
  ASSERT_EQ(advice["advice"].size(), 1u);
  EXPECT_EQ(advice["advice"][0]["state"], "both");
  EXPECT_EQ(advice["advice"][0]["helps"]["of"], "B");
  EXPECT_TRUE(advice["advice"][0]["helps"]["sigma_before_percent"].is_null());
  EXPECT_TRUE(advice["advice"][0]["helps"]["sigma_after_percent"].is_number());
}

TEST_F(AdviseSmallRoom, AGridIsReadUntilItIsEnough) {
  const json advice = Advice("--top 50");
  EXPECT_TRUE(advice["enough"].get<bool>());
  EXPECT_EQ(advice["candidates"]["photos"], 0) << "there is no camera";
  EXPECT_GT(advice["candidates"]["readings"].get<int>(), 30);
  ASSERT_FALSE(advice["advice"].empty());
  double last = 100;
  for (const json& step : advice["advice"]) {
    EXPECT_LE(step["gain_percent"].get<double>(), last + 1e-9) << "the best first";
    last = step["gain_percent"].get<double>();
    EXPECT_THAT(step["words"].get<std::string>(), HasSubstr("read state "));
    EXPECT_GE(step["position_m"][2].get<double>(), 0);
    EXPECT_LE(step["position_m"][2].get<double>(), 2.5);
  }
}

TEST_F(AdviseSmallRoom, ThePlanShowsItAndEscapesNames) {
  const support::ProgramRun run = Advise("--top 2 --plan '" + folder_.Path("plan.svg") + "'");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("worst now: flux of "));
  EXPECT_THAT(run.output, HasSubstr("\n1  read state "));
  const std::string plan = folder_.Read("plan.svg");
  EXPECT_THAT(plan, HasSubstr("1: "));
  EXPECT_THAT(plan, HasSubstr("2: "));
  EXPECT_THAT(plan, Not(HasSubstr("<script>")));
  EXPECT_FALSE(std::filesystem::exists(folder_.Path("out/advise.svg")));
}

TEST_F(AdviseSmallRoom, BadInputIsNamed) {
  EXPECT_THAT(Advise("--of Z").output, HasSubstr("--of: expected "));
  EXPECT_EQ(Advise("--of Z").status, 2);
  folder_.Write("places.csv", "id,x_m,y_m,z_m,nx,ny,nz,state\nfar,40,1,0.8,0,0,1,both\n");
  const support::ProgramRun far = Advise("--readings '" + folder_.Path("places.csv") + "'");
  EXPECT_EQ(far.status, 2);
  EXPECT_THAT(far.output, HasSubstr("places.csv:2: x_m: expected a place within the room"));
  folder_.Replace("places.csv", "40,1,0.8,0,0,1,both", "1,1,0.8,0,0,1,bath");
  EXPECT_THAT(Advise("--readings '" + folder_.Path("places.csv") + "'").output,
              HasSubstr("places.csv:2: state: expected both or half, got \"bath\"; did you mean \"both\"?"));
  const support::ProgramRun photos = Advise("--photos '" + folder_.Path("places.csv") + "'");
  EXPECT_EQ(photos.status, 2);
  EXPECT_THAT(photos.output, HasSubstr("--photos: expected a run with photos"));
}

}  // namespace
}  // namespace luxfit
