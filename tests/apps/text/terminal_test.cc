#include "apps/text/terminal.h"

#include <gmock/gmock.h>

#include "tests/paths.h"
#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(TerminalTest, BarAndTimeToGo) {
  EXPECT_EQ(ProgressText(0.25, 1), "[#####---------------]  1.0 s, 3.0 s to go");
  EXPECT_EQ(ProgressText(1, 2), "[####################]  2.0 s, 0.0 s to go");
  EXPECT_EQ(ProgressText(1.5, 3), "[####################]  3.0 s") << "longer than the last time";
  EXPECT_EQ(ProgressText(-1, 0.5), "0.5 s");
}

TEST(TerminalTest, ColoursTheFirstWordAlone) {
  EXPECT_EQ(WithColours("warning: w\nplain\n"), "\x1b[33mwarning:\x1b[0m w\nplain\n");
  EXPECT_EQ(WithColours("a warning: w"), "a warning: w");
  EXPECT_EQ(WithColours(""), "");
}

// script(1) gives the program a terminal.
TEST(TerminalTest, ColoursAndBarsOnATerminalOnly) {
  const support::ProgramRun piped = support::RunProgram("doctor");
  EXPECT_THAT(piped.output, Not(HasSubstr("\x1b[")));
  const TempFolder folder;
  const std::string run = "TERM=xterm script -qec \"'" LUXFIT_PROGRAM "' simulate " LUXFIT_FIXTURES
                          "/forward_reference/spots/session.toml -o " +
                          folder.Path("out") + "\" /dev/null >" + folder.Path("seen") + " 2>&1";
  ASSERT_EQ(std::system(run.c_str()), 0);
  EXPECT_THAT(folder.Read("seen"), AllOf(HasSubstr("\r\x1b[K"), HasSubstr("simulate  2 luminaires")));
  ASSERT_EQ(
      std::system(("TERM=xterm script -qec \"'" LUXFIT_PROGRAM "' doctor\" /dev/null >" + folder.Path("seen"))
                      .c_str()),
      0);
  EXPECT_THAT(folder.Read("seen"), HasSubstr("\x1b[32mgood\x1b[0m"));
  ASSERT_EQ(std::system(("NO_COLOR=1 TERM=xterm script -qec \"'" LUXFIT_PROGRAM "' doctor\" /dev/null >" +
                         folder.Path("seen"))
                            .c_str()),
            0);
  EXPECT_THAT(folder.Read("seen"), Not(HasSubstr("\x1b[32m")));
}

}  // namespace
}  // namespace luxfit
