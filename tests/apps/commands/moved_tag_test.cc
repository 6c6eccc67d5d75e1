// The office that an independent renderer photographed, one tag of its survey elsewhere: `luxfit register` names the tag, says where it
// hangs, and blames no view.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/apps/program.h"
#include "tests/support/office_truth.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class MovedTag : public testing::Test {
 protected:
  MovedTag() {
    std::filesystem::copy(support::kOfficeFolder, folder_.Path("office"),
                          std::filesystem::copy_options::recursive);
  }

  // Registers with the tag's centre moved along an axis of the room, and returns what was said.
  std::string RegisterWith(int id, int axis, double metres) const {
    json tags = json::parse(folder_.Read("office/tags.json"));
    for (json& tag : tags)
      if (tag["id"] == id)
        tag["center_m"][static_cast<size_t>(axis)] =
            tag["center_m"][static_cast<size_t>(axis)].get<double>() + metres;
    folder_.Write("office/tags.json", tags.dump());
    const support::ProgramRun run = support::RunProgram(
        fmt::format("register '{}' -o '{}'", folder_.Path("office/session.toml"), folder_.Path("out")));
    EXPECT_EQ(run.status, 0) << run.output;
    return run.output;
  }

  TempFolder folder_;
};

// Its views follow a tag that is 5 cm off: before each tag was tested by the others, no warning said so.
TEST_F(MovedTag, FiveCentimetresAreNamed) {
  const std::string said = RegisterWith(5, 0, 0.05);
  EXPECT_THAT(said, HasSubstr("Tag 5 disagrees with the other tags"));
  EXPECT_THAT(said, ContainsRegex("The photos show it (4[6-9]|5[0-4]) mm off its surveyed place"));
  EXPECT_THAT(said, Not(HasSubstr("See whether the camera moved")));
}

// Before, two views were blamed instead: their cameras had moved.
TEST_F(MovedTag, HalfAMetreIsNamed) {
  const std::string said = RegisterWith(1, 0, 0.5);
  EXPECT_THAT(said, HasSubstr("Tag 1 disagrees with the other tags"));
  EXPECT_THAT(said, ContainsRegex("The photos show it (4[89]|50)[0-9] mm off its surveyed place"));
  EXPECT_THAT(said, Not(HasSubstr("See whether the camera moved")));
}

}  // namespace
}  // namespace luxfit
