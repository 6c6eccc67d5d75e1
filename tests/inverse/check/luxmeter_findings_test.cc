#include "inverse/check/luxmeter_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace luxfit {
namespace {

// 4 places in 3 states, all as predicted, sigma 2 %.
std::vector<NamedReading> Agreeing() {
  std::vector<NamedReading> readings;
  for (const char* state : {"A", "B", "all"}) {
    for (const char* id : {"L1", "L2", "L3", "L4"}) {
      const double lx = 100.0 + 10 * static_cast<double>(readings.size());
      readings.push_back({id, state, {lx, lx, 0.02 * lx, 0.01 * lx}});
    }
  }
  return readings;
}

TEST(LuxmeterFindings, QuantilesOfTheNormal) {
  // Tables: Abramowitz and Stegun (1964), table 26.5.
  EXPECT_NEAR(NormalQuantile(0.5), 0, 1e-12);
  EXPECT_NEAR(NormalQuantile(0.975), 1.959963985, 1e-8);
  EXPECT_NEAR(NormalQuantile(0.001), -3.090232306, 1e-8);
  EXPECT_THROW(NormalQuantile(0), std::invalid_argument);
  EXPECT_THROW(NormalQuantile(1), std::invalid_argument);
}

TEST(LuxmeterFindings, ReadingsThatAgreeAreLeftAlone) {
  const LuxmeterFindings findings = FindDisagreements(Agreeing());
  EXPECT_FALSE(findings.has_common_factor);
  EXPECT_TRUE(findings.disagreements.empty());
  // 5 % shared by 12 readings, both sides: the normal's quantile at 1 - 0.05 / 24, by an independent program.
  EXPECT_NEAR(findings.z_limit, 2.86526024, 1e-8);
  EXPECT_TRUE(FindDisagreements({}).disagreements.empty());
}

TEST(LuxmeterFindings, OneReadingOffIsNamedAlone) {
  std::vector<NamedReading> readings = Agreeing();
  readings[5].reading.measured_lx *= 0.8;  // L2 in B
  const LuxmeterFindings findings = FindDisagreements(readings);
  EXPECT_FALSE(findings.has_common_factor);
  ASSERT_EQ(findings.disagreements.size(), 1u);
  const Disagreement& d = findings.disagreements[0];
  EXPECT_EQ(d.of, Disagreement::Of::kReading);
  EXPECT_EQ(d.id, "L2");
  EXPECT_EQ(d.state, "B");
  // 20 % below, sigma hypot(2 %, 1 %) of what is predicted.
  EXPECT_NEAR(d.z, -0.2 / std::hypot(0.02, 0.01), 1e-9);
  EXPECT_NE(d.meaning.find("L2 in state B"), std::string::npos) << d.meaning;
  EXPECT_NE(d.meaning.find("20.0 % below"), std::string::npos) << d.meaning;
}

// In B, 30 % of every prediction come straight from luminaire P, 20 % from luminaire Q.
std::vector<NamedReading> LitStraight() {
  std::vector<NamedReading> readings = Agreeing();
  for (NamedReading& named : readings) {
    if (named.state != "B") continue;
    const double lx = named.reading.predicted_lx;
    named.direct_lx = {{"P", 0.3 * lx}, {"Q", 0.2 * lx}};
  }
  return readings;
}

std::string ShadedFrom(double measured_over_predicted) {
  std::vector<NamedReading> readings = LitStraight();
  readings[5].reading.measured_lx *= measured_over_predicted;
  const LuxmeterFindings findings = FindDisagreements(readings);
  EXPECT_EQ(findings.disagreements.size(), 1u);
  return findings.disagreements.empty() ? "" : findings.disagreements[0].shaded_from;
}

TEST(LuxmeterFindings, AReadingInTheShadeOfOneLuminaireNamesIt) {
  EXPECT_EQ(ShadedFrom(0.7), "P");
  EXPECT_EQ(ShadedFrom(0.6), "P");  // what hides it hides reflected light too
  EXPECT_EQ(ShadedFrom(0.8), "Q");
  EXPECT_EQ(ShadedFrom(0.4), "") << "P is half of what is missing";
  EXPECT_EQ(ShadedFrom(1.3), "");
}

TEST(LuxmeterFindings, ShadeIsSaidWithWhatStandsBetween) {
  std::vector<NamedReading> readings = LitStraight();
  readings[5].reading.measured_lx *= 0.7;
  const LuxmeterFindings findings = FindDisagreements(readings);
  ASSERT_EQ(findings.disagreements.size(), 1u);
  const Disagreement& d = findings.disagreements[0];
  EXPECT_NE(d.meaning.find("L2 in state B"), std::string::npos) << d.meaning;
  EXPECT_NE(d.meaning.find("in the shade of P"), std::string::npos) << d.meaning;
  EXPECT_NE(d.remedy.find("between P and L2"), std::string::npos) << d.remedy;
}

TEST(LuxmeterFindings, ALuminaireThatShadesManyPlacesIsElsewhere) {
  std::vector<NamedReading> readings = LitStraight();
  for (const size_t i : {5, 6}) readings[i].reading.measured_lx *= 0.7;  // 2 of 4 places
  for (const Disagreement& d : FindDisagreements(readings).disagreements) EXPECT_EQ(d.shaded_from, "");
}

TEST(LuxmeterFindings, LightThatArrivesInAnotherStateIsNotShaded) {
  std::vector<NamedReading> readings = LitStraight();
  readings[5].reading.measured_lx *= 0.7;
  readings[5].direct_lx.pop_back();                                         // P alone
  readings[9].direct_lx = {{"P", 0.3 * readings[9].reading.predicted_lx}};  // L2 in all, as predicted
  const LuxmeterFindings findings = FindDisagreements(readings);
  ASSERT_EQ(findings.disagreements.size(), 1u);
  EXPECT_EQ(findings.disagreements[0].shaded_from, "");
}

TEST(LuxmeterFindings, ADecimalPointIsNoShade) {
  std::vector<NamedReading> readings = LitStraight();
  readings[5].reading.measured_lx *= 0.1;
  readings[5].direct_lx = {{"P", 0.9 * readings[5].reading.predicted_lx}};
  const LuxmeterFindings findings = FindDisagreements(readings);
  ASSERT_EQ(findings.disagreements.size(), 1u);
  EXPECT_EQ(findings.disagreements[0].shaded_from, "");
}

TEST(LuxmeterFindings, AReadingOffByAKnownFactorNamesTheCause) {
  const auto remedy = [](double factor) {
    std::vector<NamedReading> readings = Agreeing();
    readings[5].reading.measured_lx *= factor;
    return FindDisagreements(readings).disagreements.at(0).remedy;
  };
  EXPECT_EQ(remedy(0.1), "it is off as by a decimal point, or another range of the meter: read it again");
  EXPECT_EQ(remedy(1 / 10.764), "it is off as in foot-candles: read it again");
  EXPECT_EQ(remedy(0.5).find("it is off as"), std::string::npos);
}

TEST(LuxmeterFindings, AllOffAlikeIsAScaleAndNoDisagreement) {
  std::vector<NamedReading> readings = Agreeing();
  for (NamedReading& r : readings) r.reading.measured_lx *= 1.15;
  const LuxmeterFindings findings = FindDisagreements(readings);
  EXPECT_TRUE(findings.has_common_factor);
  EXPECT_NEAR(findings.common_factor, 1.15, 1e-12);
  EXPECT_TRUE(findings.disagreements.empty());
  EXPECT_NE(findings.common_remedy.find("scale"), std::string::npos);
}

TEST(LuxmeterFindings, AScaleAndOneReadingAreToldApart) {
  std::vector<NamedReading> readings = Agreeing();
  for (NamedReading& r : readings) r.reading.measured_lx *= 1.15;
  readings[2].reading.measured_lx *= 0.75;
  const LuxmeterFindings findings = FindDisagreements(readings);
  EXPECT_TRUE(findings.has_common_factor);
  ASSERT_EQ(findings.disagreements.size(), 1u);
  EXPECT_EQ(findings.disagreements[0].id, "L3");
  EXPECT_EQ(findings.disagreements[0].state, "A");
}

TEST(LuxmeterFindings, APlaceThatIsOffInAllStatesIsAPlace) {
  std::vector<NamedReading> readings = Agreeing();
  for (NamedReading& r : readings) {
    if (r.id == "L4") r.reading.measured_lx *= 1.3;
  }
  const LuxmeterFindings findings = FindDisagreements(readings);
  ASSERT_EQ(findings.disagreements.size(), 1u);
  EXPECT_EQ(findings.disagreements[0].of, Disagreement::Of::kPlace);
  EXPECT_EQ(findings.disagreements[0].id, "L4");
}

TEST(LuxmeterFindings, AStateThatIsOffIsAState) {
  std::vector<NamedReading> readings = Agreeing();
  for (NamedReading& r : readings) {
    if (r.state == "B") r.reading.measured_lx *= 0.6;
  }
  const LuxmeterFindings findings = FindDisagreements(readings);
  ASSERT_EQ(findings.disagreements.size(), 1u);
  EXPECT_EQ(findings.disagreements[0].of, Disagreement::Of::kState);
  EXPECT_EQ(findings.disagreements[0].state, "B");
}

TEST(LuxmeterFindings, LightWhereNoneIsPredictedIsSaidToBeSuch) {
  std::vector<NamedReading> readings = Agreeing();
  readings[0].reading.predicted_lx = 0;
  readings[0].reading.predicted_sigma_lx = 0;
  const LuxmeterFindings findings = FindDisagreements(readings);
  ASSERT_EQ(findings.disagreements.size(), 1u);
  EXPECT_NE(findings.disagreements[0].meaning.find("it measured light where none is predicted"),
            std::string::npos);
  EXPECT_NE(findings.disagreements[0].remedy.find("measure its place again"), std::string::npos);
}

}  // namespace
}  // namespace luxfit
