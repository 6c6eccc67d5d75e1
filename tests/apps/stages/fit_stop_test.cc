// Fits that end before they are done, run as a user runs them, on the office that an independent renderer photographed.
#include "apps/stages/fit_stop.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "tests/support/apps/program.h"
#include "tests/support/office_truth.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string kSession = support::kOfficeFolder + "session.toml";

bool WarnsOfStop(const json& result) {
  return std::any_of(result["warnings"].begin(), result["warnings"].end(),
                     [](const json& warning) { return warning["code"] == "fit_stopped"; });
}

double WorstPositionError(const json& result) {
  double worst = 0;
  const json office = support::OfficeTruth();
  for (const json& truth : office.at("lamps")) {
    for (const json& found : result.at("luminaires")) {
      if (found["id"] != truth["id"]) continue;
      worst = std::max(
          worst, (support::VectorOf(found["position_m"]) - support::VectorOf(truth["position"])).norm());
    }
  }
  return worst;
}

// Starts the program with its words in a file; returns its process.
pid_t Start(const std::string& out, const std::string& words) {
  const pid_t process = fork();
  if (process != 0) return process;
  const int file = open(words.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, STDERR_FILENO);
  dup2(file, STDOUT_FILENO);
  execl(LUXFIT_PROGRAM, "luxfit", "fit", kSession.c_str(), "-o", out.c_str(), nullptr);
  _exit(127);
}

TEST(FitStop, SaysWhichLimitWasReached) {
  const FitStop ample(1e6);
  EXPECT_EQ(ample.Reason(), "");
  EXPECT_EQ(ample.ReasonOfCount(), "");
  EXPECT_NEAR(ample.LeftS(), 1e6, 100);
  const FitStop spent(1e-9);
  EXPECT_EQ(spent.Reason(), "its budget of 1e-09 s is spent");
  EXPECT_EQ(spent.LeftS(), 0);
  raise(SIGINT);
  EXPECT_EQ(spent.Reason(), "it was interrupted (Ctrl-C or SIGTERM)");
}

TEST(FitStop, ASpentBudgetLeavesAMarkedResultThatTheNextRunTakesUp) {
  const TempFolder folder;
  const std::string command = "fit '" + kSession + "' -o '" + folder.Path("out") + "'";
  const support::ProgramRun stopped = support::RunProgram(command + " --budget 0.001");
  EXPECT_EQ(stopped.status, 1) << stopped.output;
  EXPECT_THAT(stopped.output, HasSubstr("its budget of 0.001 s is spent"));
  const json early = json::parse(folder.Read("out/result.json"));
  EXPECT_EQ(early["status"], "undetermined");
  EXPECT_THAT(early["status_because"].dump(), HasSubstr("fit_stopped"));
  EXPECT_EQ(early["stopped"]["reason"], "its budget of 0.001 s is spent");
  EXPECT_TRUE(WarnsOfStop(early));
  EXPECT_EQ(early["luminaires"].size(), 4u);
  const support::ProgramRun whole = support::RunProgram(command);
  EXPECT_EQ(whole.status, 0) << whole.output;
  const json late = json::parse(folder.Read("out/result.json"));
  EXPECT_FALSE(late.contains("stopped"));
  EXPECT_FALSE(late.contains("status_because"));
  EXPECT_FALSE(WarnsOfStop(late));
}

TEST(FitStop, CtrlCEndsWithTheBestStateSoFar) {
  const TempFolder folder;
  const pid_t process = Start(folder.Path("out"), folder.Path("words"));
  ASSERT_GT(process, 0);
  int status = 0;
  bool has_ended = false;
  while (!has_ended && folder.Read("words").find("\nrefine") == std::string::npos) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    has_ended = waitpid(process, &status, WNOHANG) != 0;
  }
  ASSERT_FALSE(has_ended) << folder.Read("words");
  kill(process, SIGINT);
  waitpid(process, &status, 0);
  ASSERT_TRUE(WIFEXITED(status)) << folder.Read("words");
  EXPECT_EQ(WEXITSTATUS(status), 1) << folder.Read("words");
  const json result = json::parse(folder.Read("out/result.json"));
  EXPECT_EQ(result["stopped"]["reason"], "it was interrupted (Ctrl-C or SIGTERM)");
  EXPECT_EQ(result["stopped"]["step"], "refine");
  EXPECT_TRUE(WarnsOfStop(result));
  EXPECT_LT(WorstPositionError(result), 0.02) << "the models were chosen before";
}

}  // namespace
}  // namespace luxfit
