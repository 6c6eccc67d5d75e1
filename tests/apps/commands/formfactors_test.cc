// `luxfit formfactors`, as a user runs it: what it writes, and what it says of bad input.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// A unit cube seen from inside: a patch a face.
constexpr char kCube[] =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nusemtl wall\n"
    "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

class FormFactorsCommandTest : public testing::Test {
 protected:
  FormFactorsCommandTest() { folder_.Write("cube.obj", kCube); }

  support::ProgramRun Run(const std::string& mesh, const std::string& out,
                          const std::string& flags = "") const {
    return support::RunProgram("formfactors '" + folder_.Path(mesh) + "' -o '" + folder_.Path(out) + "' " +
                               flags);
  }

  // What it says where it ends with status 2.
  std::string Refusal(const std::string& mesh, const std::string& out, const std::string& flags = "") const {
    const support::ProgramRun run = Run(mesh, out, flags);
    EXPECT_EQ(run.status, 2) << run.output;
    EXPECT_FALSE(std::filesystem::exists(folder_.Path(out)));
    return run.output;
  }

  TempFolder folder_;
};

// Howell's catalogue C-11 and C-14 for the unit cube.
constexpr double kOpposite = 0.199825, kAdjacent = 0.200044;

TEST_F(FormFactorsCommandTest, WritesTheMatrixOfACube) {
  for (const std::string method :
       {"hybrid", "analytic", "malley", "malley_stratified", "isocell", "montecarlo"}) {
    const support::ProgramRun run =
        Run("cube.obj", "f.json", "--patch-size 1 --rays 40000 --json --method " + method);
    ASSERT_EQ(run.status, 0) << run.output;
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
    EXPECT_EQ(nlohmann::json::parse(run.output)["patches"], 6);  // and no warning
  }
}

TEST_F(FormFactorsCommandTest, WritesATable) {
  const support::ProgramRun run = Run("cube.obj", "f.csv", "--unit cm --patch-size 0.005");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(folder_.Read("f.csv"), StartsWith("patch,facet,material,area_m2,x_m,y_m,z_m,f_0,f_1"));
  EXPECT_THAT(folder_.Read("f.csv"), HasSubstr("\n23,5,wall,2.5e-05,"));
  EXPECT_THAT(run.output, HasSubstr("24 patches, hybrid"));
}

// A floor drawn twice receives what one does, and the user is told.
TEST_F(FormFactorsCommandTest, CutsAndReportsWhatIsDrawnTwice) {
  folder_.Write("twice.obj", std::string(kCube) + "f 1 2 3 4\n");
  const support::ProgramRun run = Run("twice.obj", "f.json", "--patch-size 1");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("6 patches"), HasSubstr("warning: "), HasSubstr("remedy: ")));
  const nlohmann::json file = nlohmann::json::parse(folder_.Read("f.json"));
  EXPECT_NEAR(file["form_factors"][0][1].get<double>(), kOpposite, 1e-6);
}

TEST_F(FormFactorsCommandTest, WarnsOfAnOpenMesh) {
  folder_.Write("open.obj", std::string(kCube).substr(0, std::string(kCube).rfind("f 4 8 5 1")));
  const support::ProgramRun run = Run("open.obj", "f.json", "--patch-size 1");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("warning: "), HasSubstr("end in the open"), HasSubstr("remedy: ")));
}

TEST_F(FormFactorsCommandTest, SaysWhatIsWrong) {
  EXPECT_THAT(Refusal("cube.obj", "f.csv", "--method malay"), HasSubstr("did you mean \"malley\"?"));
  EXPECT_THAT(Refusal("cube.obj", "f.txt"), HasSubstr("ending in .csv or .json"));
  EXPECT_THAT(Refusal("cube.obj", "f.csv", "--unit yard"), HasSubstr("--unit: expected"));
  EXPECT_THAT(Refusal("none.obj", "f.csv"), HasSubstr("none.obj"));
  EXPECT_THAT(Refusal("cube.obj", "f.csv", "--rays 0"), HasSubstr("--rays"));
  EXPECT_THAT(Refusal("cube.obj", "f.csv", "--patch-size 0.001"),
              HasSubstr("expected at most 30000 patches"));
}

}  // namespace
}  // namespace luxfit
