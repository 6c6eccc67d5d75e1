// Groups of luminaires, and states that name them.
#include <gmock/gmock.h>

#include "apps/session/session.h"
#include "tests/support/apps/tiny_session.h"

namespace luxfit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr char kTinyStates[] = "[states]\nZ = { Z = 1.0 }\nall = { A = 0.5, Z = 1 }\n";
constexpr char kOthers[] = "[[luminaire]]\nid = \"A\"\n[[luminaire]]\nid = \"Z\"\n[luxmeter]";

// The tiny session with luminaires B, A and Z in [[luminaire]].
class SessionGroupsTest : public TinySessionTest {
 protected:
  void Write(const std::string& groups, const std::string& states) const {
    Reset();
    folder_.Replace("session.toml", "[luxmeter]", kOthers);
    folder_.Replace("session.toml", kTinyStates, "[groups]\n" + groups + "[states]\n" + states);
  }
  std::string ErrorOf(const std::string& groups, const std::string& states) const {
    Write(groups, states);
    return Error();
  }
};

TEST_F(SessionGroupsTest, AStateNamesGroupsAndLuminaires) {
  Write("row = [\"A\", \"B\"]\nends = [\"B\", \"Z\"]\n", "Z = { Z = 1 }\nall = { row = 0.5, Z = 1 }\n");
  const Session session = Read();
  ASSERT_EQ(session.groups.size(), 2u);
  EXPECT_EQ(session.groups[0].name, "row");
  EXPECT_EQ(session.groups[0].luminaires, (std::vector<std::string>{"A", "B"}));
  EXPECT_EQ(session.states[0].dimming, (std::map<std::string, double>{{"Z", 1}}));
  EXPECT_EQ(session.states[1].dimming, (std::map<std::string, double>{{"A", 0.5}, {"B", 0.5}, {"Z", 1}}));
  ASSERT_EQ(session.luminaires.size(), 3u);
  EXPECT_EQ(session.luminaires[0].id, "B");
}

TEST_F(SessionGroupsTest, WhatOverlapsAgrees) {
  const std::string groups = "row = [\"A\", \"B\"]\nends = [\"B\", \"Z\"]\n";
  EXPECT_EQ(ErrorOf(groups, "Z = {}\nall = { row = 0.5, ends = 0.5, A = 0.5 }\n"), "");
  EXPECT_EQ(Read().states[1].dimming, (std::map<std::string, double>{{"A", 0.5}, {"B", 0.5}, {"Z", 0.5}}));
  EXPECT_THAT(
      ErrorOf(groups, "Z = {}\nall = { row = 0.5, A = 1.0 }\n"),
      HasSubstr(
          "session.toml:34: states.all.A: expected one dimming of \"A\", got 1.0 beside that of \"row\""));
  EXPECT_THAT(ErrorOf(groups, "Z = {}\nall = { A = 1.0, row = 0.5 }\n"),
              HasSubstr("states.all.row: expected one dimming of \"A\", got 0.5 beside that of \"A\""));
  EXPECT_THAT(ErrorOf(groups, "Z = {}\nall = { row = 1, ends = 0.5 }\n"),
              HasSubstr("states.all.ends: expected one dimming of \"B\", got 0.5 beside that of \"row\""));
}

TEST_F(SessionGroupsTest, WithoutDescriptionsGroupsNameTheLuminaires) {
  Reset();
  folder_.Write("session.toml",
                "[groups]\nrow2 = [\"D\", \"C\"]\nrow1 = [\"B\", \"A\"]\n[states]\none = { row1 = 1 }\n"
                "both = { row1 = 1, row2 = 1 }\nC = { C = 1 }\n");
  const Session session = Read();
  std::string ids;
  for (const SessionLuminaire& luminaire : session.luminaires) ids += luminaire.id;
  EXPECT_EQ(ids, "DCBA");
  EXPECT_EQ(session.states[0].dimming, (std::map<std::string, double>{{"A", 1}, {"B", 1}}));
  EXPECT_FALSE(session.count_is_estimated);
}

TEST_F(SessionGroupsTest, UnknownNamesAreErrors) {
  const std::string states = "Z = { row = 1 }\nall = { Z = 1 }\n";
  EXPECT_THAT(
      ErrorOf("row = [\"A\", \"C1\"]\n", states),
      AllOf(HasSubstr("session.toml:30: groups.row[1]: expected a luminaire of [[luminaire]] (B, A or Z)"),
            HasSubstr("got \"C1\"; add [[luminaire]] with this id")));
  EXPECT_THAT(ErrorOf("row = [\"A\"]\n", "Z = { raw = 1 }\nall = { Z = 1 }\n"),
              AllOf(HasSubstr("session.toml:32: states.Z.raw: expected a group or a luminaire"),
                    HasSubstr("(B, A, Z or row), got \"raw\"; did you mean \"row\"?")));
  Reset();
  folder_.Write("session.toml", "[groups]\nrow = [\"A\", \"B\"]\n[states]\none = { C = 1 }\n");
  EXPECT_THAT(Error(), HasSubstr("session.toml:4: states.one.C: expected a group or a luminaire"));
}

TEST_F(SessionGroupsTest, GroupsAreChecked) {
  const std::string states = "Z = { row = 1 }\nall = { Z = 1 }\n";
  EXPECT_THAT(ErrorOf("row = []\n", states),
              HasSubstr("session.toml:30: groups.row: expected one luminaire or more, got []"));
  EXPECT_THAT(ErrorOf("", states), HasSubstr("session.toml:29: groups: expected at least one group"));
  EXPECT_THAT(ErrorOf("row = \"A\"\n", states), HasSubstr("groups.row: expected a list of luminaires"));
  EXPECT_THAT(ErrorOf("row = [1]\n", states),
              HasSubstr("groups.row[0]: expected the id of a luminaire, got 1"));
  EXPECT_THAT(ErrorOf("row = [\"A\", \"A\"]\n", states),
              HasSubstr("groups.row[1]: expected each luminaire once, got \"A\" twice"));
  EXPECT_THAT(ErrorOf("row = [\"A\"]\nB = [\"A\"]\n", states),
              HasSubstr("session.toml:31: groups.B: expected a name that no luminaire has, got \"B\""));
  EXPECT_THAT(ErrorOf("row = [\"A\"]\n", "Z = { row = 30 }\nall = { Z = 1 }\n"),
              HasSubstr("states.Z.row: expected a dimming in 0..1, got 30"));
  Reset();
  folder_.Write("session.toml", "[groups]\nrow = [\"A\"]\nA = [\"B\"]\n[states]\none = { row = 1 }\n");
  EXPECT_THAT(Error(), HasSubstr("session.toml:3: groups.A: expected a name that no luminaire has"));
  folder_.Write("session.toml", "[groups]\nrow = [\"A\"]\n");
  EXPECT_THAT(Error(), HasSubstr("session.toml:1: groups: expected [states] beside it"));
}

TEST_F(SessionGroupsTest, TheNumberOfAGroupMayBeOpen) {
  Reset();
  folder_.Write("session.toml",
                "[groups]\nrow1 = \"estimate\"\nrow2 = [\"C\", \"D\"]\n[states]\ndim = { row1 = 0.5 }\n"
                "one = { row1 = 1, row2 = 0 }\nall = { row1 = 0.8, row2 = 1 }\n");
  const Session open = Read();
  ASSERT_EQ(open.luminaires.size(), 3U);
  EXPECT_EQ(open.luminaires[0].id, "row1");  // stands for all of them
  EXPECT_TRUE(open.groups[0].count_is_estimated);
  EXPECT_FALSE(open.groups[1].count_is_estimated);
  EXPECT_FALSE(open.count_is_estimated);
  EXPECT_EQ(StateOfGroupAlone(open, "row1"), 1);  // the brightest
  EXPECT_EQ(StateOfGroupAlone(open, "row2"), -1);
  const Session counted = WithCountedGroup(open, "row1", 2);
  std::string ids;
  for (const SessionLuminaire& luminaire : counted.luminaires) ids += luminaire.id + " ";
  EXPECT_EQ(ids, "row1_1 row1_2 C D ");
  EXPECT_EQ(counted.groups[0].luminaires, (std::vector<std::string>{"row1_1", "row1_2"}));
  EXPECT_EQ(counted.states[0].dimming, (std::map<std::string, double>{{"row1_1", 0.5}, {"row1_2", 0.5}}));
  EXPECT_EQ(counted.states[2].dimming,
            (std::map<std::string, double>{{"C", 1}, {"D", 1}, {"row1_1", 0.8}, {"row1_2", 0.8}}));
}

TEST_F(SessionGroupsTest, AnOpenGroupNeedsAStateOfItsOwn) {
  Reset();
  folder_.Write("session.toml", "[groups]\nrow1 = \"estimate\"\n[states]\nall = { row1 = 1, A = 1 }\n");
  EXPECT_THAT(Error(), HasSubstr("states.all.A: expected a group or a luminaire"));
  folder_.Write("session.toml",
                "[groups]\nrow1 = \"estimate\"\nrow2 = [\"A\"]\n[states]\nall = { row1 = 1, row2 = 1 }\n");
  EXPECT_THAT(Error(),
              AllOf(HasSubstr("session.toml:2: groups.row1: expected a state in which row1 alone is on"),
                    HasSubstr("add one to [states], as in row1 = { row1 = 1.0 }, with photos")));
  folder_.Write("session.toml",
                "[groups]\nrow1 = \"estimate\"\n[states]\nall = { row1 = 1 }\n[luminaires]\ncount = 1\n");
  EXPECT_THAT(Error(),
              HasSubstr("luminaires.count: expected nothing beside a group whose number is to be estimated"));
}

}  // namespace
}  // namespace luxfit
