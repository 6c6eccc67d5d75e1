#include "inverse/choose/internal/detail/ambient_left.h"

#include <gtest/gtest.h>

#include <cmath>

namespace luxfit {
namespace {

constexpr double kPrior = 0.3;

// A fit by hand: three states, of the last of which nothing but the prior tells the share.
LuminaireFit FitOf(const Eigen::Vector3d& share, double sigma) {
  LuminaireFit fit;
  fit.state.camera_scale_free = false;
  fit.state.ambient_share = share;
  fit.state.ambient_shares_free = true;
  fit.parameters = FreeParameters(MakeRoom(Scene{}), fit.state);
  fit.covariance = Eigen::Vector3d(sigma, sigma, kPrior).cwiseAbs2().asDiagonal();
  return fit;
}

TEST(AmbientLeft, SharesWithinTheirErrorsAreNone) {
  const AmbientLeft left = AmbientLeftIn(FitOf({0.01, -0.02, 0}, 0.01), kPrior);
  EXPECT_EQ(left.states, (std::vector<int>{0, 1}));
  EXPECT_NEAR(left.chi2, 5, 1e-9);
  EXPECT_NEAR(left.chi2_95, 5.991, 0.12);  // two degrees of freedom, to the 2 % of the formula
  EXPECT_FALSE(left.IsNeeded());
  EXPECT_EQ(left.Spread(), 0);
}

TEST(AmbientLeft, SharesBeyondTheirErrorsAreSome) {
  const AmbientLeft left = AmbientLeftIn(FitOf({0.03, -0.04, 0}, 0.01), kPrior);
  EXPECT_TRUE(left.IsNeeded());
  EXPECT_NEAR(left.Spread(), std::sqrt((9 + 16) / 2.) / 100, 1e-12);
}

TEST(AmbientLeft, ReadingsGetTheSpreadOfTheirAmbientPart) {
  Reading reading{{{0, 0, 1}, {0, 0, 1}, {}}};
  reading.sigma_lx = 3;
  reading.ambient_lx = 40;
  EXPECT_NEAR(WithAmbientSpread({reading}, 0.1).front().sigma_lx, 5, 1e-12);
}

TEST(AmbientLeft, StatesWithoutAreHeldAtNone) {
  const LightState state = WithoutAmbientLeft(FitOf({0.1, 0.2, 0}, 0.01).state);
  EXPECT_TRUE(state.ambient_share.isZero());
  EXPECT_FALSE(state.ambient_shares_free);
}

}  // namespace
}  // namespace luxfit
