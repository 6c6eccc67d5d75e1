// `luxfit formfactors`, as a user runs it: what it writes, and what it says of bad input.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// A unit cube seen from inside: a patch a face.
constexpr char kCube[] =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nusemtl wall\n"
    "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

class FormFactorsCommandTest : public testing::Test {
 protected:
  FormFactorsCommandTest() { folder_.Write("cube.obj", kCube); }

  int Run(const std::string& arguments) {
    const std::string command = "cd '" + folder_.Path("") + "' && '" LUXFIT_PROGRAM "' formfactors " +
                                arguments + " >stdout.txt 2>stderr.txt";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  TempFolder folder_;
};

// Howell's catalogue C-11 and C-14 for the unit cube.
constexpr double kOpposite = 0.199825, kAdjacent = 0.200044;

TEST_F(FormFactorsCommandTest, WritesTheMatrixOfACube) {
  for (const std::string method :
       {"hybrid", "analytic", "malley", "malley_stratified", "isocell", "montecarlo"}) {
    ASSERT_EQ(Run("cube.obj -o f.json --patch-size 1 --rays 40000 --json --method " + method), 0)
        << folder_.Read("stderr.txt");
    const nlohmann::json file = nlohmann::json::parse(folder_.Read("f.json"));
    EXPECT_EQ(file["format"], "luxfit-formfactors-1");
    EXPECT_EQ(file["method"], method);
    ASSERT_EQ(file["form_factors"].size(), 6u);
    const bool exact = method == "hybrid" || method == "analytic";
    // Four standard deviations of 40 000 independent rays for the others.
    const double tolerance = exact ? 1e-6 : 4 * std::sqrt(0.2 * 0.8 / 40000);
    EXPECT_NEAR(file["form_factors"][0][1].get<double>(), kOpposite, tolerance) << method;
    for (size_t j = 2; j < 6; ++j)
      EXPECT_NEAR(file["form_factors"][0][j].get<double>(), kAdjacent, tolerance) << method;
    EXPECT_EQ(nlohmann::json::parse(folder_.Read("stdout.txt"))["patches"], 6);
  }
}

TEST_F(FormFactorsCommandTest, WritesATable) {
  ASSERT_EQ(Run("cube.obj -o f.csv --unit cm --patch-size 0.005"), 0) << folder_.Read("stderr.txt");
  EXPECT_THAT(folder_.Read("f.csv"), StartsWith("patch,facet,material,area_m2,x_m,y_m,z_m,f_0,f_1"));
  EXPECT_THAT(folder_.Read("f.csv"), HasSubstr("\n23,5,wall,2.5e-05,"));
  EXPECT_THAT(folder_.Read("stdout.txt"), HasSubstr("24 patches, hybrid"));
}

TEST_F(FormFactorsCommandTest, SaysWhatIsWrong) {
  EXPECT_EQ(Run("cube.obj -o f.csv --method malay"), 2);
  EXPECT_THAT(folder_.Read("stderr.txt"), HasSubstr("did you mean \"malley\"?"));
  EXPECT_EQ(Run("cube.obj -o f.txt"), 2);
  EXPECT_THAT(folder_.Read("stderr.txt"), HasSubstr("ending in .csv or .json"));
  EXPECT_EQ(Run("cube.obj -o f.csv --unit yard"), 2);
  EXPECT_THAT(folder_.Read("stderr.txt"), HasSubstr("--unit: expected"));
  EXPECT_EQ(Run("none.obj -o f.csv"), 2);
  EXPECT_THAT(folder_.Read("stderr.txt"), HasSubstr("none.obj"));
  EXPECT_EQ(Run("cube.obj -o f.csv --rays 0"), 2);
  EXPECT_FALSE(std::filesystem::exists(folder_.Path("f.csv")));
}

}  // namespace
}  // namespace luxfit
