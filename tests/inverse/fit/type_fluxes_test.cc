#include "inverse/fit/internal/judge/type_fluxes.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <vector>

namespace luxfit {
namespace {

constexpr double kSigma = 0.01;  // of each log flux

// A fit by hand of eight like luminaires with 1.5 % between them.
class TypeFluxes : public testing::Test {
 protected:
  TypeFluxes() {
    fit_.status = FitStatus::kConverged;
    for (int k = 0; k < 8; ++k) {
      Luminaire luminaire;
      luminaire.flux_lm = 3000 * (1 + 0.015 * (k % 2 == 0 ? 1 : -1));
      luminaire.position = {1.0 * k, 1, 2.7};
      fit_.state.luminaires.push_back(luminaire);
    }
    fit_.state.free.resize(8);
    fit_.state.first_of_type.assign(8, 0);
  }

  std::vector<LuminaireType> Compared(double common_sigma = 0) {
    fit_.parameters = FreeParameters(MakeRoom(Scene{}), fit_.state);
    const auto n = static_cast<Eigen::Index>(fit_.parameters.size());
    fit_.covariance = kSigma * kSigma * Eigen::MatrixXd::Identity(n, n) +
                      Eigen::MatrixXd::Constant(n, n, std::pow(common_sigma, 2));
    return CompareTypeFluxes(fit_);
  }

  LuminaireFit fit_;
};

TEST_F(TypeFluxes, AreTheMedianWithASpread) {
  const std::vector<LuminaireType> types = Compared();
  ASSERT_EQ(types.size(), 1u);
  EXPECT_EQ(types[0].luminaires.size(), 8u);
  EXPECT_NEAR(types[0].flux, 3000, 1);
  EXPECT_NEAR(types[0].relative_spread, 1.4826 * 0.015, 1e-4);
  EXPECT_TRUE(types[0].deviating.empty());
}

TEST_F(TypeFluxes, OneAtSeventyPercentIsNamedAlone) {
  fit_.state.luminaires[3].flux_lm = 0.7 * 3000;
  const std::vector<DeviatingFlux> deviating = Compared().at(0).deviating;
  ASSERT_EQ(deviating.size(), 1u);
  EXPECT_EQ(deviating[0].luminaire, 3);
  EXPECT_NEAR(deviating[0].ratio, 0.7, 0.02);
  EXPECT_LT(deviating[0].z, -5);
}

// The scale reading's error is in all fluxes: it neither hides nor makes a deviation.
TEST_F(TypeFluxes, AnErrorOfAllFluxesHidesNone) {
  fit_.state.luminaires[3].flux_lm = 0.7 * 3000;
  const double alone = Compared().at(0).deviating.at(0).z;
  EXPECT_NEAR(Compared(0.2).at(0).deviating.at(0).z, alone, 1e-9);
}

TEST_F(TypeFluxes, AnUncertainOneDoesNotDeviate) {
  fit_.state.luminaires[3].flux_lm = 0.7 * 3000;
  Compared();
  for (size_t i = 0; i < fit_.parameters.size(); ++i) {
    const auto own = static_cast<Eigen::Index>(i);
    if (fit_.parameters[i].Is(ParameterKind::kLogFlux, 3, {})) fit_.covariance(own, own) = 0.2 * 0.2;
  }
  EXPECT_TRUE(CompareTypeFluxes(fit_).at(0).deviating.empty());
}

// Luminaires whose fluxes differ by 2 %, and by 5 %: as many rooms as the rule allows name one of them.
TEST_F(TypeFluxes, RoomsWithoutAnAgedOneAreLeftAlone) {
  constexpr int kRooms = 2000;
  std::mt19937_64 rng(5);
  for (const int count : {3, 4, 5, 6, 8}) {
    for (int k = 0; k < 8; ++k) fit_.state.first_of_type[static_cast<size_t>(k)] = k < count ? 0 : k;
    Compared();  // sets the covariance
    for (const double spread : {0.02, 0.05}) {
      int named = 0;
      for (int room = 0; room < kRooms; ++room) {
        for (Luminaire& luminaire : fit_.state.luminaires)
          luminaire.flux_lm = 3000 * std::exp(spread * std::normal_distribution<double>()(rng));
        named += CompareTypeFluxes(fit_).at(0).deviating.empty() ? 0 : 1;
      }
      EXPECT_LT(named, 0.01 * kRooms) << spread << ", " << count;
    }
  }
}

// Four within 0.3 % of one another, and one at 96 %: four do not show that luminaires of the type differ no more.
TEST_F(TypeFluxes, FewThatAreAlikeByChanceDoNotAccuseAnother) {
  fit_.state.first_of_type = {0, 0, 0, 0, 0, 5, 6, 7};
  for (int k = 0; k < 5; ++k)
    fit_.state.luminaires[static_cast<size_t>(k)].flux_lm = 3000 * (k == 4 ? 0.96 : 1 + 0.001 * k);
  EXPECT_TRUE(Compared().at(0).deviating.empty());
  fit_.state.luminaires[4].flux_lm = 0.75 * 3000;
  ASSERT_EQ(Compared().at(0).deviating.size(), 1u);
  EXPECT_EQ(Compared().at(0).deviating[0].luminaire, 4);
}

// Two of a row of three agree, and the third has three quarters of their flux: makers allow 10 %.
TEST_F(TypeFluxes, TheWeakOneOfThreeIsNamed) {
  fit_.state.first_of_type = {0, 0, 0, 3, 4, 5, 6, 7};
  for (int k = 0; k < 3; ++k)
    fit_.state.luminaires[static_cast<size_t>(k)].flux_lm = 3000 * (k == 1 ? 0.75 : 1 + 0.01 * k);
  const std::vector<DeviatingFlux> deviating = Compared().at(0).deviating;
  ASSERT_EQ(deviating.size(), 1u);
  EXPECT_EQ(deviating[0].luminaire, 1);
}

TEST_F(TypeFluxes, TwoDoNotTellWhichDeviates) {
  fit_.state.first_of_type = {0, 0, 2, 3, 4, 5, 6, 7};
  fit_.state.luminaires[1].flux_lm = 2000;
  const std::vector<LuminaireType> types = Compared();
  ASSERT_EQ(types.size(), 1u);
  EXPECT_TRUE(std::isnan(types[0].relative_spread));
  EXPECT_TRUE(types[0].deviating.empty());
}

}  // namespace
}  // namespace luxfit
