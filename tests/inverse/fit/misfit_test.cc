#include "inverse/fit/internal/judge/misfit.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// A fit by hand: A is on in states 0 and 2, B in 1 and 2. A hundred rows a state; weights of 1 but where a test says so.
class Misfit : public testing::Test {
 protected:
  Misfit() : room_(MakeRoom(support::ClosedRoom({4, 3, 2.8}), {{0.4, 0.1}, {}})) {
    result_.fit.state.luminaires.resize(2);
    result_.fit.state.luminaires[0].id = "A", result_.fit.state.luminaires[1].id = "B";
    result_.data.dimming = {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 1)};
    for (int state = 0; state < 3; ++state) {
      for (int i = 0; i < kRows; ++i) {
        result_.data.observations.emplace_back();
        result_.data.observations.back().element = i, result_.data.observations.back().state = state;
      }
    }
    result_.fit.weight = Eigen::VectorXd::Ones(3 * kRows);
    result_.fit.relative_sigma = 0.01;
  }
  Findings Found() const {
    Findings findings;
    WarnOfMisfit(room_, result_, findings);
    return findings;
  }
  static constexpr int kRows = 100;
  const Room room_;
  RoomFit result_;
};

TEST_F(Misfit, AFewRowsAreNone) {
  result_.fit.weight.segment(kRows, 14).setConstant(0.1);
  EXPECT_TRUE(Found().warnings.empty());
}

TEST_F(Misfit, OneStateNamesItsLuminaires) {
  result_.fit.weight.segment(kRows, 15).setConstant(0.1);
  const Findings findings = Found();
  ASSERT_EQ(findings.warnings.size(), 1u);
  EXPECT_EQ(findings.warnings[0].code, "model_misfit");
  EXPECT_NE(findings.warnings[0].message.find("most where B shine: 15 %"), std::string::npos)
      << findings.warnings[0].message;
  EXPECT_TRUE(findings.IsUndetermined());
}

TEST_F(Misfit, ALargeErrorThatNeighboursShareIsAWarning) {
  result_.fit.relative_sigma = 0.03;
  result_.fit.shared_relative_sigma = 0.01;
  const Findings findings = Found();
  ASSERT_EQ(findings.warnings.size(), 1u);
  EXPECT_FALSE(findings.IsUndetermined());
}

TEST_F(Misfit, NoiseOfSingleRowsIsOneOnlyWhereItIsVeryLarge) {
  result_.fit.relative_sigma = 0.04;
  result_.fit.shared_relative_sigma = 0.003;
  EXPECT_TRUE(Found().warnings.empty());
  result_.fit.relative_sigma = 0.06;
  EXPECT_EQ(Found().warnings.size(), 1u);
}

TEST_F(Misfit, RowsThatTookNoPartAreNotCounted) {
  result_.fit.weight.segment(kRows, 30).setZero();
  EXPECT_TRUE(Found().warnings.empty());
}

}  // namespace
}  // namespace luxfit
