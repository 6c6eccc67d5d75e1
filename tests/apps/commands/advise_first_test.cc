// `luxfit advise` on sessions without a run: a room of four lines, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class AdviseFirst : public testing::Test {
 protected:
  support::ProgramRun Advise(const std::string& options = "") const {
    return support::RunProgram("advise '" + folder_.Path("session.toml") + "' " + options);
  }

  const TempFolder folder_;
};

TEST_F(AdviseFirst, ARoomAndANumberOfLuminairesAreEnough) {
  folder_.Write("session.toml", "[scene]\nsize = [4, 3, 2.5]\n[luminaires]\ncount = 2\n");
  const support::ProgramRun run = Advise("-o '" + folder_.Path("plan") + "'");
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("assumed: place of lamp1, lamp2: on a grid under the ceiling\n"));
  EXPECT_THAT(run.output, HasSubstr("assumed: camera: 65 degrees wide"));
  EXPECT_THAT(run.output, HasSubstr("\n1  photograph state lamp"));
  const json advice = json::parse(folder_.Read("plan/advise.json"));
  EXPECT_EQ(advice["format"], "luxfit-advise-1");
  EXPECT_FALSE(advice["assumed"].empty());
  EXPECT_GT(advice["candidates"]["photos"].get<int>(), 0);
  EXPECT_TRUE(advice["now"][0]["sigma_before_percent"].is_null());
  EXPECT_TRUE(advice["advice"][0]["state_is_new"].get<bool>());
  for (const json& change : advice["advice"].back()["changes"])
    EXPECT_FALSE(change[change["kind"] == "position" ? "sigma_after_m" : "sigma_after_percent"].is_null());
  const std::string plan = folder_.Read("plan/advise.svg");
  EXPECT_THAT(plan, HasSubstr("what to take first"));
  EXPECT_THAT(plan, HasSubstr(">lamp1<"));
}

TEST_F(AdviseFirst, TheFolderOfASessionWillDoAndNothingIsWrittenIntoIt) {
  folder_.Write("session.toml", "[scene]\nsize = [4, 3, 2.5]\n");
  const support::ProgramRun run = support::RunProgram("advise '" + folder_.Path("") + "' --top 1");
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("assumed: count: 2: one for every 6 m2 of the floor\n"));
  EXPECT_FALSE(std::filesystem::exists(folder_.Path("advise.json")));
}

TEST_F(AdviseFirst, PhotosAloneLeaveLumensUndetermined) {
  folder_.Write("session.toml", "[scene]\nsize = [4, 3, 2.5]\n[luminaires]\ncount = 1\n");
  const support::ProgramRun run = Advise("--only photos --of flux --top 50");
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output, HasSubstr("no more to advise: no "));
  EXPECT_THAT(run.output, HasSubstr("not determined by any of these: flux of lamp1; allow other candidates"));
}

TEST_F(AdviseFirst, BadInputIsNamed) {
  folder_.Write("session.toml", "name = \"nowhere\"\n");
  EXPECT_EQ(Advise().status, 2);
  EXPECT_THAT(Advise().output, HasSubstr("session.toml: scene: expected the room"));
  folder_.Write("session.toml", "[scene]\nsize = [4, 3, 2.5]\n");
  EXPECT_THAT(Advise("--session x.toml").output, HasSubstr("--session: expected a run before it"));
  EXPECT_THAT(Advise("--of Z").output, HasSubstr("--of: expected "));
}

}  // namespace
}  // namespace luxfit
