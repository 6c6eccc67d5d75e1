#include "calib/colour/colour_temperature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/calib/spectral_camera.h"

namespace luxfit {
namespace {

const Eigen::Matrix3d kExact = Eigen::Matrix3d::Zero();

Eigen::Vector3d XyzOfChromaticity(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

// CIE 15:2018, table T.1 and 9.5: illuminants A, D50, D65 and FL2. D65's duv is that of ANSI C78.377's method.
TEST(ColourTemperature, StandardIlluminants) {
  const struct {
    double x, y, kelvin;
  } illuminants[] = {
      {0.44758, 0.40745, 2856}, {0.34567, 0.35851, 5003}, {0.31272, 0.32903, 6504}, {0.37208, 0.37529, 4230}};
  for (const auto& [x, y, kelvin] : illuminants) {
    const auto found = ColourTemperatureOf(XyzOfChromaticity(x, y), kExact);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->kelvin, kelvin, 0.004 * kelvin);
    EXPECT_NEAR((found->xy - Eigen::Vector2d(x, y)).norm(), 0, 1e-12);
    EXPECT_EQ(found->kelvin_sigma, 0);
  }
  EXPECT_NEAR(ColourTemperatureOf(XyzOfChromaticity(0.44758, 0.40745), kExact)->duv, 0, 2e-4);
  EXPECT_NEAR(ColourTemperatureOf(XyzOfChromaticity(0.31272, 0.32903), kExact)->duv, 0.0032, 2e-4);
}

// Its own spectrum, weighed by an approximate observer: within 1 %.
TEST(ColourTemperature, PlancksRadiatorsHaveTheirTemperature) {
  for (const double kelvin : {2700.0, 3500.0, 4000.0, 6500.0, 12000.0}) {
    const auto found = ColourTemperatureOf(support::XyzOf(support::Planck(kelvin)), kExact);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->kelvin, kelvin, 0.013 * kelvin);
    EXPECT_NEAR(found->duv, 0, 1e-3);
  }
}

TEST(ColourTemperature, SigmaIsThatOfDraws) {
  const Eigen::Vector3d xyz = XyzOfChromaticity(0.38, 0.38), sigma(0.01, 0.01, 0.02);
  const auto found = ColourTemperatureOf(xyz, sigma.cwiseAbs2().asDiagonal());
  ASSERT_TRUE(found);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  double squares = 0, duv_squares = 0;
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    Eigen::Vector3d drawn = xyz;
    for (int c = 0; c < 3; ++c) drawn[c] *= std::exp(sigma[c] * normal(random));
    const auto other = ColourTemperatureOf(drawn, kExact);
    ASSERT_TRUE(other);
    squares += std::pow(other->kelvin - found->kelvin, 2);
    duv_squares += std::pow(other->duv - found->duv, 2);
  }
  EXPECT_NEAR(found->kelvin_sigma, std::sqrt(squares / kDraws), 0.05 * found->kelvin_sigma);
  EXPECT_NEAR(found->duv_sigma, std::sqrt(duv_squares / kDraws), 0.05 * found->duv_sigma);
}

TEST(ColourTemperature, OtherColoursHaveNone) {
  EXPECT_FALSE(ColourTemperatureOf(XyzOfChromaticity(0.17, 0.70), kExact));  // green
  EXPECT_FALSE(ColourTemperatureOf(XyzOfChromaticity(0.16, 0.02), kExact));  // violet
  EXPECT_FALSE(ColourTemperatureOf({0, 0, 0}, kExact));
  EXPECT_FALSE(ColourTemperatureOf({std::numeric_limits<double>::quiet_NaN(), 1, 1}, kExact));
}

}  // namespace
}  // namespace luxfit
