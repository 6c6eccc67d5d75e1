#include "apps/session/report_targets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/scenes.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using testing::HasSubstr;

class ReportTargetsTest : public testing::Test {
 protected:
  ReportTargets Read(const std::string& text) const {
    folder_.Write("targets.toml", text);
    return ReadTargets(folder_.Path("targets.toml"));
  }
  std::string Error(const std::string& text) const {
    try {
      Read(text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  TempFolder folder_;
};

TEST_F(ReportTargetsTest, EverythingThatCanBeWritten) {
  const ReportTargets targets = Read(R"([[area]]
id = "desk"
task = "drawing"
average_lx = 800
height_m = 0.8
polygon_m = [[0, 0], [2, 0], [2, 1]]

[[area]]
id = "board"
origin_m = [0, 1, 1]
edge_u_m = [0, 2, 0]
edge_v_m = [0, 0, 1]
spacing_m = 0.2

[[observer]]
id = "guest"
eye_m = [1, 2, 1.2]
looking = [0, 2, 0]
ugr = 22
)");
  ASSERT_EQ(targets.areas.size(), 2U);
  EXPECT_EQ(targets.areas[0].average_lx, 800);  // beside the task's 750
  EXPECT_EQ(targets.areas[0].uniformity, 0.7);
  EXPECT_EQ(targets.areas[0].polygon_m.size(), 3U);
  EXPECT_FALSE(targets.areas[1].average_lx);
  EXPECT_TRUE(targets.areas[1].plane->edge_u.isApprox(Eigen::Vector3d(0, 2, 0)));
  ASSERT_EQ(targets.observers.size(), 1U);
  EXPECT_TRUE(targets.observers[0].looking.isApprox(Eigen::Vector3d(0, 1, 0)));
  // What is written comes back.
  const ReportTargets again = Read(TargetsToml(targets));
  EXPECT_EQ(again.areas[0].average_lx, 800);
  EXPECT_EQ(again.areas[0].height_m, 0.8);
  EXPECT_TRUE(again.areas[1].plane->origin.isApprox(targets.areas[1].plane->origin));
  EXPECT_EQ(again.observers[0].ugr, 22);
}

TEST_F(ReportTargetsTest, ErrorsNameFileLineAndKey) {
  EXPECT_THAT(Error("[[area]]\nid = \"a\"\naverage = 500\n"),
              HasSubstr("targets.toml:3: area[0].average: expected a known key"));
  EXPECT_THAT(Error("[[area]]\nid = \"a\"\ntask = \"writting\"\n"), HasSubstr("did you mean \"writing\"?"));
  EXPECT_THAT(
      Error("[[area]]\nid = \"a\"\nuniformity = 60\n"),
      HasSubstr("targets.toml:3: area[0].uniformity: expected a share in 0..1, got 60; 60 % is written 0.6"));
  EXPECT_THAT(Error("[[area]]\nid = \"a\"\naverage_lx = -5\n"),
              HasSubstr(":3: area[0].average_lx: expected > 0"));
  EXPECT_THAT(Error("[[area]]\nid = \"a\"\n[[area]]\nid = \"a\"\n"),
              HasSubstr(":4: area[1].id: expected a name of its own"));
  EXPECT_THAT(Error("[[area]]\nid = \"a\"\npolygon_m = [[0, 0], [1, 1]]\n"),
              HasSubstr(":3: area[0].polygon_m"));
  EXPECT_THAT(Error("[[area]]\nid = \"a\"\npolygon_m = [[0, 0, 0], [1, 1], [1, 0]]\n"),
              HasSubstr("expected a corner [x, y] in m"));
  EXPECT_THAT(
      Error("[[area]]\nid = \"a\"\norigin_m = [0, 0, 0]\nedge_u_m = [1, 0, 0]\nedge_v_m = [2, 0, 0]\n"),
      HasSubstr("not parallel"));
  EXPECT_THAT(Error("[[area]]\nid = \"a\"\norigin_m = [0, 0, 0]\nheight_m = 1\n"),
              HasSubstr("got both; remove one"));
  EXPECT_THAT(Error("[[observer]]\nid = \"o\"\neye_m = [0, 0, 1]\nlooking = [0, 0, 1]\n"),
              HasSubstr("not vertical"));
  EXPECT_THAT(Error("maintenance_factor = 80\n"),
              HasSubstr("targets.toml:1: maintenance_factor: expected a share in 0..1"));
  EXPECT_THAT(Error("[power_w]\nA = 0\n"),
              HasSubstr("targets.toml:2: power_w.A: expected > 0, got 0; write it in W"));
  EXPECT_THAT(Error("[[area]]\nid = \"a\"\nwall_lx = -1\n"),
              HasSubstr("area[0].wall_lx: expected > 0, got -1; write it in lx"));
  EXPECT_THAT(Error("# nothing\n"), HasSubstr("got neither"));
  EXPECT_THAT(Error("[[area]\n"), HasSubstr("expected valid TOML"));
  EXPECT_THROW(ReadTargets(folder_.Path("none.toml")), std::runtime_error);
}

TEST_F(ReportTargetsTest, FactorAndPowersAreWrittenAsTheyAreRead) {
  const ReportTargets targets = Read(
      "maintenance_factor = 0.8\n[power_w]\nA = 36\n\"row 1\" = 14.5\n[[area]]\nid = \"a\"\ntask = "
      "\"archive\"\n"
      "wall_lx = 90\n");
  folder_.Write("again.toml", TargetsToml(targets));
  const ReportTargets again = ReadTargets(folder_.Path("again.toml"));
  EXPECT_EQ(again.maintenance_factor, 0.8);
  ASSERT_EQ(again.powers.size(), 2U);
  EXPECT_EQ(again.powers[1].id, "row 1");
  EXPECT_EQ(again.powers[1].power_w, 14.5);
  EXPECT_EQ(again.areas[0].cylindrical_lx, 75);
  EXPECT_EQ(again.areas[0].wall_lx, 90);  // beside the task's 75
  EXPECT_EQ(again.areas[0].ceiling_lx, 50);
}

TEST_F(ReportTargetsTest, TheDefaultIsTheFloorAgainstOfficeWork) {
  const ReportTargets targets = DefaultTargets(support::ClosedRoom({6, 4, 2.8}));
  ASSERT_EQ(targets.areas.size(), 1U);
  EXPECT_EQ(targets.areas[0].average_lx, 500);
  EXPECT_EQ(targets.areas[0].height_m, 0.75);
  ASSERT_EQ(targets.observers.size(), 4U);
  EXPECT_EQ(targets.observers[0].id, "looking along +x");
  EXPECT_TRUE(targets.observers[0].eye_m.isApprox(Eigen::Vector3d(0.2, 2, 1.2)));
  EXPECT_TRUE(DefaultTargets(Scene{}).areas.empty());
  EXPECT_EQ(Read(TargetsToml(targets)).observers.size(), 4U);
}

}  // namespace
}  // namespace luxfit
