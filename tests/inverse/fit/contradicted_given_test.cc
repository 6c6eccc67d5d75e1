#include "inverse/fit/internal/judge/contradicted_given.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace luxfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A fit by hand of two luminaires, in lm, and what is given of the second.
class ContradictedGivenOf : public testing::Test {
 protected:
  ContradictedGivenOf() {
    for (const char* id : {"A", "B"}) {
      Luminaire luminaire;
      luminaire.id = id;
      luminaire.position = {1.5, 2, 2.8};
      luminaire.flux_lm = 3600;
      fit_.fit.state.luminaires.push_back(luminaire);
      given_.luminaires.emplace_back();
      given_.luminaires.back().luminaire.id = id;
    }
    fit_.fit.status = FitStatus::kConverged;
    fit_.luminaire_found = {true, true};
    fit_.absolute = true;
  }
  KnownLuminaire& Given() { return given_.luminaires[1]; }
  ContradictedGiven Found() const { return FindContradictedGiven(given_, fit_); }

  RoomObservations given_;
  RoomFit fit_;
};

TEST_F(ContradictedGivenOf, PlacesWithinTheirSigmasAreNot) {
  Given().position_m = Eigen::Vector3d(1.52, 2, 2.78);
  Given().position_sigma_m = 0.01;
  EXPECT_THAT(Found().places, IsEmpty());
  Given().position_sigma_m = 0.005;
  EXPECT_THAT(Found().places, ElementsAre(1));
}

TEST_F(ContradictedGivenOf, OnlyWhatHasASigmaCounts) {
  Given().position_m = Eigen::Vector3d(3, 2, 2.8);
  Given().flux_lm = 100;
  EXPECT_THAT(Found().places, IsEmpty());  // a start
  EXPECT_THAT(Found().fluxes, IsEmpty());
  Given().position_sigma_m = Given().flux_sigma_lm = 0;
  EXPECT_THAT(Found().places, IsEmpty());  // held
  EXPECT_THAT(Found().fluxes, IsEmpty());
}

TEST_F(ContradictedGivenOf, FluxesAreWhereTheFitHasLumens) {
  Given().flux_lm = 7200;
  Given().flux_sigma_lm = 50;
  EXPECT_THAT(Found().fluxes, ElementsAre(1));
  Given().flux_sigma_lm = 2500;
  EXPECT_THAT(Found().fluxes, IsEmpty());
  Given().flux_lm = 3700;  // 3 % off: the model's own errors are as large
  Given().flux_sigma_lm = 10;
  EXPECT_THAT(Found().fluxes, IsEmpty());
  Given().flux_lm = 7200;
  Given().flux_sigma_lm = 50;
  fit_.absolute = false;
  EXPECT_THAT(Found().fluxes, IsEmpty());
}

// Places that explain the light equally are as uncertain as they are apart.
TEST_F(ContradictedGivenOf, AnAmbiguousPlaceContradictsNothing) {
  Given().position_m = Eigen::Vector3d(3, 2, 2.8);
  Given().position_sigma_m = 0.01;
  Luminaire rival = fit_.fit.state.luminaires[1];
  rival.position.x() = 3;
  fit_.ambiguous.push_back({1, fit_.fit.state.luminaires[1], {rival}});
  EXPECT_THAT(Found().places, IsEmpty());
}

TEST_F(ContradictedGivenOf, TheWarningSaysWhereTheDataShowIt) {
  Given().position_m = Eigen::Vector3d(2, 2, 2.8);
  Given().position_sigma_m = 0.01;
  RoomFit as_given = fit_;
  as_given.fit.relative_sigma = 0.09;
  fit_.fit.relative_sigma = 0.005;
  Findings findings;
  WarnOfPlaceLeftOut(Given(), fit_, as_given, findings);
  ASSERT_EQ(findings.warnings.size(), 1u);
  EXPECT_THAT(findings.warnings[0].message,
              HasSubstr("B at (1.50, 2.00, 2.80) m, 0.50 m from its position_m, which is given to 0.01 m"));
  EXPECT_THAT(findings.warnings[0].message, HasSubstr("0.5 % without it, to 9 % with it"));
  EXPECT_FALSE(findings.IsUndetermined());
  const RoomObservations without = WithoutPlacesOf({1}, given_);
  EXPECT_FALSE(without.luminaires[1].position_m || without.luminaires[1].position_sigma_m);
}

}  // namespace
}  // namespace luxfit
