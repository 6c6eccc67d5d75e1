#include "inverse/fit/internal/judge/odd_luminaires.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "inverse/fit/internal/words.h"
#include "tests/support/inverse/luminaire_outlines.h"

namespace luxfit {
namespace {

// A fit by hand of five panels, the first four on one switch.
class OddLuminaires : public testing::Test {
 protected:
  OddLuminaires() {
    fit_.status = FitStatus::kConverged;
    for (int k = 0; k < 5; ++k) {
      Luminaire panel;
      panel.id = "P" + std::to_string(k + 1);
      panel.shape = LuminaireShape::kRectangle;
      panel.size_m = {0.6, 0.6};
      panel.flux_lm = 3600 + 20 * k;
      panel.position = {1.0 * k, 1, 2.7};
      fit_.state.luminaires.push_back(panel);
    }
    fit_.state.free.resize(5);
    data_.dimming = {Eigen::VectorXd(5), Eigen::VectorXd(5)};
    data_.dimming[0] << 1, 1, 1, 1, 0;
    data_.dimming[1] << 0.5, 0.5, 0.5, 0.5, 1;
  }

  Luminaire& Panel(size_t k) { return fit_.state.luminaires[k]; }
  std::vector<OddLuminaire> Found() {
    fit_.parameters = FreeParameters(MakeRoom(Scene{}), fit_.state);
    return FindOddLuminaires(fit_, data_);
  }

  LuminaireFit fit_;
  LightData data_;
};

TEST_F(OddLuminaires, LikePanelsAreNotOdd) { EXPECT_TRUE(Found().empty()); }

// As a row of five ended once: one of 4.5 m x 1.3 m with twice the light, and one with 45 lm.
TEST_F(OddLuminaires, OneForTwoAndOneLeftOver) {
  Panel(1).size_m = {4.5, 1.3};
  Panel(1).flux_lm = 7232;
  Panel(3).flux_lm = 45;
  const std::vector<OddLuminaire> odd = Found();
  ASSERT_EQ(odd.size(), 2u);
  EXPECT_EQ(odd[0].luminaire, 1);
  EXPECT_FALSE(odd[0].is_left_over);
  EXPECT_NEAR(odd[0].area_ratio, 4.5 * 1.3 / 0.36, 1e-9);
  EXPECT_EQ(odd[0].fellows, (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(odd[1].luminaire, 3);
  EXPECT_TRUE(odd[1].is_left_over);
  EXPECT_NEAR(odd[1].flux_ratio, 45.0 / 3640, 1e-9);  // the fellows' median
}

TEST_F(OddLuminaires, AnAgedOneAndALargerOneAreReal) {
  Panel(0).flux_lm = 700;
  Panel(2).size_m = {1.2, 1.2};
  EXPECT_TRUE(Found().empty());
}

TEST_F(OddLuminaires, APanelAmongDownlightsIsSeen) {
  for (const size_t k : {0, 1, 2}) Panel(k).shape = LuminaireShape::kDisc, Panel(k).size_m = {0.12, 0.12};
  ASSERT_EQ(Found().size(), 1u);  // no photo shows it
  LuminaireOutline outline;
  outline.luminaire = 3;
  data_.outlines = {outline};
  EXPECT_TRUE(Found().empty());
}

TEST_F(OddLuminaires, OneLargePanelMakesAnotherCommon) {
  for (const size_t k : {0, 1}) Panel(k).shape = LuminaireShape::kDisc, Panel(k).size_m = {0.12, 0.12};
  EXPECT_TRUE(Found().empty());
}

TEST_F(OddLuminaires, OneSwitchedAloneHasNoFellows) {
  Panel(4).flux_lm = 1;
  EXPECT_TRUE(Found().empty());
}

TEST_F(OddLuminaires, TwoDoNotTellWhichIsOdd) {
  data_.dimming[0] << 1, 1, 0, 0, 0;
  data_.dimming[1] << 0, 0, 1, 0.3, 1;
  Panel(0).flux_lm = 1;
  EXPECT_TRUE(Found().empty());
}

TEST_F(OddLuminaires, GivenFluxesAreNotJudged) {
  Panel(3).flux_lm = 45;
  fit_.state.free[3].flux = false;
  EXPECT_TRUE(Found().empty());
}

// Photos show all panels as they are; the fit has one of 2.9 m x 2.4 m, with or without fellows.
TEST_F(OddLuminaires, OneFarLargerThanPhotosShowIsNamed) {
  std::vector<LuminaireOutline> outlines;
  for (int k = 0; k < 5; ++k)
    outlines.push_back({k, support::OutlineFrom({3, 3, 1}, fit_.state.luminaires[static_cast<size_t>(k)])});
  EXPECT_TRUE(FindOversizedLuminaires(fit_, outlines).empty());
  Panel(4).size_m = {2.9, 2.4};
  Panel(0).size_m = {1.2, 1.2};
  const std::vector<OversizedLuminaire> oversized = FindOversizedLuminaires(fit_, outlines);
  ASSERT_EQ(oversized.size(), 1u);
  EXPECT_EQ(oversized[0].luminaire, 4);
  EXPECT_NEAR(oversized[0].shown_m2, 0.36, 0.03);  // 32 points cut the square's corners
  EXPECT_TRUE(FindOversizedLuminaires(fit_, {}).empty());
  Findings findings;
  WarnOfOversizedLuminaires(fit_.state, oversized, findings);
  EXPECT_TRUE(findings.IsUndetermined());
  ASSERT_EQ(findings.warnings.size(), 1u);
  EXPECT_EQ(findings.warnings[0].code, "luminaire_unlike_photos");
}

TEST_F(OddLuminaires, TheResultIsUndeterminedAndSaysWhy) {
  Panel(3).flux_lm = 45;
  Findings findings;
  WarnOfOddLuminaires(fit_.state, Found(), findings);
  EXPECT_TRUE(findings.IsUndetermined());
  ASSERT_EQ(findings.warnings.size(), 1u);
  EXPECT_EQ(findings.warnings[0].code, "luminaire_unlike_others");
  EXPECT_EQ(findings.warnings[0].message,
            "P4 gives 1.2 % of the light of P1, P2, P3, which are always on together with it: another may "
            "stand for "
            "two, and this one is left over");
}

}  // namespace
}  // namespace luxfit
