#include "apps/text/process.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "apps/text/interrupt.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

class ProcessTest : public testing::Test {
 protected:
  ProcessEnd Run(const std::string& script, double time_limit_s = 0) const {
    return RunProcess({"sh", "-c", script},
                      {folder_.Path("log"), time_limit_s, {{"LUXFIT_GREETING", "hello"}}});
  }
  TempFolder folder_;
};

TEST_F(ProcessTest, StatusOutputAndEnvironmentArrive) {
  EXPECT_TRUE(Run("echo $LUXFIT_GREETING; echo there >&2").IsSuccess());
  EXPECT_THAT(folder_.Read("log"), testing::HasSubstr("hello\nthere\n"));
  const ProcessEnd failed = Run("exit 3");
  EXPECT_FALSE(failed.IsSuccess());
  EXPECT_EQ(failed.Describe(), "ended with status 3");
  EXPECT_THAT(folder_.Read("log"), testing::HasSubstr("hello"));  // appended, not replaced
}

TEST_F(ProcessTest, SignalsAreNamed) {
  EXPECT_THAT(Run("kill -ABRT $$").Describe(), testing::HasSubstr("was ended by signal 6"));
}

// The grandchild must go too, or it would hold the machine for a minute.
TEST_F(ProcessTest, WhatTakesTooLongIsStoppedWithItsChildren) {
  const auto start = std::chrono::steady_clock::now();
  const ProcessEnd end = Run("sleep 60 & wait", 0.1);
  EXPECT_TRUE(end.timed_out);
  EXPECT_FALSE(end.IsSuccess());
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 30);
}

// As COLMAP is stopped by Ctrl-C during `luxfit run`.
TEST_F(ProcessTest, AWishToStopStopsIt) {
  const InterruptListener listener;
  const auto start = std::chrono::steady_clock::now();
  const ProcessEnd end = Run(fmt::format("kill -INT {}; sleep 60 & wait", getpid()));
  EXPECT_TRUE(end.interrupted);
  EXPECT_FALSE(end.IsSuccess());
  EXPECT_EQ(end.Describe(), "was stopped (Ctrl-C or SIGTERM)");
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 30);
}

// A caller that is killed cannot stop its program itself.
TEST_F(ProcessTest, ItEndsWithItsCaller) {
  const pid_t caller = fork();
  if (caller == 0) {
    Run("echo $$ > " + folder_.Path("pid") + ".new; mv " + folder_.Path("pid") + ".new " +
        folder_.Path("pid") + "; exec sleep 60");
    _exit(0);
  }
  const auto within = [](const auto& holds) {
    for (int i = 0; i < 3000 && !holds(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return holds();
  };
  ASSERT_TRUE(within([&] { return std::filesystem::exists(folder_.Path("pid")); }));
  const pid_t program = std::stoi(folder_.Read("pid"));
  EXPECT_EQ(kill(program, 0), 0);
  kill(caller, SIGKILL);
  waitpid(caller, nullptr, 0);
  // Its new parent may not have reaped it yet: what has ended has no command line.
  const std::string command_line = fmt::format("/proc/{}/cmdline", program);
  EXPECT_TRUE(within([&] {
    std::ifstream file(command_line);
    return !file || file.peek() == std::ifstream::traits_type::eof();
  }));
}

TEST_F(ProcessTest, MissingProgramsNameTheirPackage) {
  EXPECT_FALSE(IsInstalled("luxfit-no-such-program"));
  EXPECT_TRUE(IsInstalled("sh"));
  try {
    RunProcess({"luxfit-no-such-program"}, {folder_.Path("log"), 0, {}});
    FAIL() << "expected MissingProgram";
  } catch (const MissingProgram& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("install the package luxfit-no-such-program"));
  }
}

TEST_F(ProcessTest, ALogThatCannotBeWrittenIsNamed) {
  EXPECT_THROW(RunProcess({"sh", "-c", "true"}, {folder_.Path("none/log"), 0, {}}), std::runtime_error);
}

}  // namespace
}  // namespace luxfit
