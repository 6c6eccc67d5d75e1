#include "inverse/model/fit_uncertainty.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "inverse/model/fit_luminaires.h"

namespace luxfit {
namespace {

using testing::ElementsAre;

const ParameterId kX{ParameterKind::kLuminaire, "A", LuminaireQuantity::kPositionX};
const ParameterId kY{ParameterKind::kLuminaire, "A", LuminaireQuantity::kPositionY};
const ParameterId kFluxOfA{ParameterKind::kLogFlux, "A"};
const ParameterId kFluxOfB{ParameterKind::kLogFlux, "B"};

// Knows x to 2 cm and the flux of A to 5 %, does not determine the flux of B, and held y.
FitUncertainty Known() {
  FitUncertainty known;
  known.parameters = {kX, kFluxOfA, kFluxOfB};
  known.is_determined = {true, true, false};
  known.covariance = Eigen::Vector3d(4e-4, 25e-4, 1).asDiagonal();
  known.covariance(0, 1) = known.covariance(1, 0) = 1e-4;
  return known;
}

TEST(FitUncertainty, HeldIsZeroAndUndeterminedIsNaN) {
  const FitUncertainty known = Known();
  EXPECT_DOUBLE_EQ(known.Sigma(kX), 0.02);
  EXPECT_EQ(known.Covariance(kX, kFluxOfA), 1e-4);
  EXPECT_EQ(known.Sigma(kY), 0);
  EXPECT_EQ(known.Covariance(kX, kY), 0);
  EXPECT_TRUE(std::isnan(known.Sigma(kFluxOfB)));
  EXPECT_TRUE(std::isnan(known.Covariance(kX, kFluxOfB)));
  EXPECT_THAT(known.Undetermined(), ElementsAre(kFluxOfB));
}

TEST(FitUncertainty, WithoutACovarianceNothingIsKnown) {
  FitUncertainty known = Known();
  known.covariance.resize(0, 0);
  EXPECT_TRUE(std::isnan(known.Sigma(kX)));
  EXPECT_EQ(known.Sigma(kY), 0);
}

TEST(FitUncertainty, PositionsAndFluxesAreItsParts) {
  Eigen::Matrix3d position = Eigen::Matrix3d::Zero();
  position(0, 0) = 4e-4;
  EXPECT_TRUE(PositionCovariance(Known(), "A") == position);
  std::vector<Luminaire> luminaires(2);
  luminaires[0].id = "B";
  luminaires[1].id = "A";
  const Eigen::MatrixXd flux = FluxCovariance(Known(), luminaires);
  EXPECT_TRUE(std::isnan(flux(0, 0)));
  EXPECT_TRUE(std::isnan(flux(0, 1)));
  EXPECT_EQ(flux(1, 1), 25e-4);
}

TEST(FitUncertainty, IsThatOfTheFit) {
  LuminaireFit fit;
  fit.state.luminaires.resize(1);
  fit.state.luminaires[0].id = "A";
  fit.state.luminaires[0].position.x() = 1.5;
  fit.state.luminaires[0].flux_lm = std::exp(2.0);
  Parameter x, flux;
  flux.kind = ParameterKind::kLogFlux;
  x.owner = flux.owner = "A";
  x.upper = flux.upper = 10;
  fit.parameters = {x, flux};
  fit.covariance = Eigen::Vector2d(0.01, 0.04).asDiagonal();
  fit.undetermined = {flux.id()};
  fit.shared_relative_sigma = 0.007;
  const FitUncertainty known = UncertaintyOf(fit);
  EXPECT_THAT(known.parameters, ElementsAre(kX, kFluxOfA));
  EXPECT_DOUBLE_EQ(known.values[0], 1.5);
  EXPECT_DOUBLE_EQ(known.values[1], 2.0);
  EXPECT_DOUBLE_EQ(known.Sigma(kX), 0.1);
  EXPECT_TRUE(std::isnan(known.Sigma(kFluxOfA)));
  EXPECT_EQ(known.relative_model_sigma, 0.007);
}

}  // namespace
}  // namespace luxfit
