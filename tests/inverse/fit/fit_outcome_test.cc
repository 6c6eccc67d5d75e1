// Checks what users read from a fit, on fits made by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "inverse/fit/fit_room.h"

namespace luxfit {
namespace {

// Returns an absolute fit of the flux of one luminaire, whose logarithm has the given sigma.
RoomFit FitOfFlux(double sigma) {
  RoomFit fit;
  fit.absolute = true;
  fit.luminaire_found = {true};
  fit.fit.state.luminaires.resize(1);
  fit.fit.state.luminaires[0].id = "A";
  fit.fit.state.luminaires[0].flux_lm = 1000;
  fit.fit.state.free.resize(1);
  Parameter flux;
  flux.kind = ParameterKind::kLogFlux;
  flux.index = 0;
  flux.owner = "A";
  fit.fit.parameters = {flux};
  fit.fit.covariance = Eigen::MatrixXd::Constant(1, 1, sigma * sigma);
  return fit;
}

TEST(FitOutcome, AFluxIsKnownByItsSigma) {
  EXPECT_TRUE(IsFluxKnown(FitOfFlux(0.02), 0));
  EXPECT_FALSE(IsFluxKnown(FitOfFlux(1.5), 0));
  EXPECT_DOUBLE_EQ(EstimatedLuminaires(FitOfFlux(0.02))[0].flux_sigma, 20);
}

TEST(FitOutcome, AFluxWithoutASigmaIsNotKnown) {
  RoomFit undetermined = FitOfFlux(0.02);
  undetermined.fit.undetermined = {undetermined.fit.parameters[0].id()};
  for (const RoomFit& fit : {undetermined, FitOfFlux(std::numeric_limits<double>::quiet_NaN())}) {
    EXPECT_FALSE(IsFluxKnown(fit, 0));
    EXPECT_TRUE(std::isnan(EstimatedLuminaires(fit)[0].flux));
  }
}

TEST(FitOutcome, AHeldFluxIsKnown) {
  RoomFit fit = FitOfFlux(0.02);
  fit.fit.parameters.clear();
  fit.fit.covariance.resize(0, 0);
  EXPECT_TRUE(IsFluxKnown(fit, 0));
}

}  // namespace
}  // namespace luxfit
