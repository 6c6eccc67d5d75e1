// The office that an independent renderer photographed, its mesh mirrored or shifted: the cause is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/apps/office_copy.h"
#include "tests/support/apps/program.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class MisplacedMesh : public testing::Test {
 protected:
  void ChangeX(const std::function<double(double)>& x_of, bool is_mirror) {
    office_.MapMesh([&](const Eigen::Vector3d& p) { return Eigen::Vector3d(x_of(p.x()), p.y(), p.z()); },
                    is_mirror);
  }

  support::ProgramRun Fit() const { return office_.Run("fit", "--budget 5"); }

  support::OfficeCopy office_;
};

TEST_F(MisplacedMesh, AMirroredMeshIsNamedAndLeavesTheResultUndetermined) {
  ChangeX([](double x) { return 6 - x; }, true);
  const support::ProgramRun run = Fit();
  EXPECT_EQ(run.status, 1) << run.output;
  const json result = office_.Json("out/result.json");
  EXPECT_THAT(result["status_because"].dump(), HasSubstr("mesh_as_if"));
  const std::string warnings = result["warnings"].dump();
  EXPECT_THAT(warnings, HasSubstr("the mesh looks mirrored in x"));
  EXPECT_THAT(warnings, HasSubstr("export the mesh with 6 - x for x"));
  EXPECT_THAT(warnings, HasSubstr("12 of 12 surveyed tags lie on it so, and 10 as given"));
  // Nothing of the mirrored furniture is called missing or moved.
  EXPECT_THAT(warnings, Not(HasSubstr("furniture_")));
  // The next run, which reads what this one kept, says it again.
  EXPECT_EQ(Fit().status, 1);
  EXPECT_THAT(office_.Read("out/result.json"), HasSubstr("the mesh looks mirrored in x"));
}

TEST_F(MisplacedMesh, AShiftThatTheTagsContradictIsRefusedWithItsSize) {
  ChangeX([](double x) { return x + 0.5; }, false);
  const support::ProgramRun run = Fit();
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("displaced against the surveyed tags by (0.500, 0.000, 0.000) m"));
  EXPECT_THAT(run.output, HasSubstr("move the mesh by (-0.500, 0.000, 0.000) m"));
}

}  // namespace
}  // namespace luxfit
