// `luxfit room` as a user runs it: what it prints, draws and refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "tests/paths.h"
#include "tests/support/apps/program.h"
#include "tests/support/forward/scan_of.h"
#include "tests/support/scenes.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kOfficeFixture = std::string(LUXFIT_FIXTURES) + "/office";

constexpr char kRoom[] = R"([scene]
outline = [[0, 0], [7.2, 0], [7.2, 3], [4, 3], [4, 5], [0, 5]]
height = 2.5

[[scene.box]]
name = "desk & chair"
min = [1, 1, 0]
max = [2, 2, 0.75]

[[scene.opening]]
name = "door"
wall = 2
from = 1
to = 1.9
high = 2.1
)";

class RoomCommandTest : public testing::Test {
 protected:
  support::ProgramRun Run(const std::string& file, const std::string& options = "") const {
    return support::RunProgram("room '" + file + "' " + options);
  }
  TempFolder folder_;
};

TEST_F(RoomCommandTest, AnOutlineIsMeasuredAndDrawn) {
  folder_.Write("session.toml", kRoom);
  const support::ProgramRun run = Run(folder_.Path("session.toml"), "-o '" + folder_.Path("plan.svg") + "'");
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.output, AllOf(HasSubstr("7.20 x 5.00 x 2.50 m"), HasSubstr("an outline of 6 corners"),
                                HasSubstr("volume 73.25 m3"), HasSubstr("1.89 m2"),
                                HasSubstr("good  the surfaces close and face the room")));
  const std::string plan = folder_.Read("plan.svg");
  EXPECT_THAT(plan, AllOf(testing::StartsWith("<svg"), HasSubstr(">wall 6<"), HasSubstr(">door<"),
                          HasSubstr(">desk &amp; chair<"), HasSubstr("</svg>")));
  EXPECT_EQ(std::distance(fs::directory_iterator(fs::path(folder_.Path("plan.svg")).parent_path()), {}), 2)
      << "nothing half-written";
}

TEST_F(RoomCommandTest, JsonHasTheSame) {
  folder_.Write("session.toml", kRoom);
  const nlohmann::json room = nlohmann::json::parse(Run(folder_.Path("session.toml"), "--json").output);
  EXPECT_NEAR(room.at("volume_m3").get<double>(), 29.6 * 2.5 - 0.75, 1e-9);
  EXPECT_EQ(room.at("materials").size(), 10U);
  EXPECT_EQ(room.at("findings").at(0).at("health"), "good");
}

TEST_F(RoomCommandTest, AMeshAndASessionWithAMeshAreTheSameRoom) {
  const support::ProgramRun mesh = Run(kOfficeFixture + "/room.obj"),
                            session = Run(kOfficeFixture + "/session.toml");
  EXPECT_EQ(mesh.status, 0);
  EXPECT_EQ(session.status, 0);
  EXPECT_THAT(mesh.output, HasSubstr("6.00 x 4.00 x 2.80 m"));
  // 67.2 less the desks, a cabinet without bottom and a door without back.
  EXPECT_THAT(mesh.output, HasSubstr("volume 66.12 m3"));
  EXPECT_EQ(mesh.output.substr(mesh.output.find('\n')), session.output.substr(session.output.find('\n')));
}

TEST_F(RoomCommandTest, WhatIsWrongIsSaid) {
  folder_.Write("open.obj",
                "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\n"
                "f 1 2 3 4\nf 1 4 8 5\nf 2 6 7 3\nf 1 5 6 2\nf 4 3 7 8\n");
  const support::ProgramRun open = Run(folder_.Path("open.obj"));
  EXPECT_EQ(open.status, 0) << "a room may be open";
  EXPECT_THAT(open.output, AllOf(HasSubstr("volume -"), HasSubstr("note  4 edges (8 m) end in the open")));
  folder_.Write("flipped.obj",
                "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\n"
                "f 4 3 2 1\nf 1 4 8 5\nf 2 6 7 3\nf 1 5 6 2\nf 4 3 7 8\nf 5 8 7 6\n");
  const support::ProgramRun flipped = Run(folder_.Path("flipped.obj"));
  EXPECT_EQ(flipped.status, 1);
  EXPECT_THAT(flipped.output, HasSubstr("bad   1 facets (4 m2) are wound against their neighbours"));
}

TEST_F(RoomCommandTest, TagsThatMissTheRoomAreSaidAndThePlanIsDrawn) {
  folder_.Write("session.toml",
                "[scene]\nsize = [5, 5, 3]\n[tags]\nmap = \"" + kOfficeFixture + "/tags.json\"\n");
  const support::ProgramRun run = Run(folder_.Path("session.toml"), "-o '" + folder_.Path("plan.svg") + "'");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output,
              HasSubstr("scene.outline: expected the surveyed tags to lie on the room's surfaces"));
  EXPECT_TRUE(fs::exists(folder_.Path("plan.svg")));
}

TEST_F(RoomCommandTest, BadInputWritesNothing) {
  folder_.Write("session.toml", "[scene]\nsize = [6, 4]\n");
  for (const auto& [file, out, message] :
       {std::tuple{"session.toml", "plan.svg", "scene.size: expected the room's three lengths"},
        std::tuple{"no.obj", "plan.svg", "no.obj"},
        std::tuple{"session.toml", "plan.png", "--out: expected a file name ending in .svg"}}) {
    const support::ProgramRun run = Run(folder_.Path(file), "-o '" + folder_.Path(out) + "'");
    EXPECT_EQ(run.status, 2) << file;
    EXPECT_THAT(run.output, HasSubstr(message));
    EXPECT_FALSE(fs::exists(folder_.Path(out)));
  }
  EXPECT_THAT(Run(kOfficeFixture + "/room.obj", "--unit yd").output, HasSubstr("--unit: expected"));
}

TEST_F(RoomCommandTest, AScanIsLaidOntoPlanes) {
  std::mt19937_64 rng(3);
  support::WriteTriangles(support::ScanOf(support::ClosedRoom({4, 3, 2.5}), {}, rng),
                          folder_.Path("scan.obj"));
  const support::ProgramRun run = support::RunProgram("room " + folder_.Path("scan.obj"));
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("facets on "), HasSubstr("planes"), HasSubstr("wall 4"),
                                HasSubstr("ceiling"), HasSubstr("the surfaces close and face the room")));
}

}  // namespace
}  // namespace luxfit
