#include "forward/views/illuminance_plane.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

TEST(PlaneStatistics, OfFourPointsByHand) {
  const Eigen::Vector4d lux(100, 300, 200, 7);
  const PlaneStatistics s = StatisticsOf(lux, {true, true, true, false});
  EXPECT_EQ(s.points, 3);
  EXPECT_DOUBLE_EQ(s.average_lx, 200);
  EXPECT_DOUBLE_EQ(s.least_lx, 100);
  EXPECT_DOUBLE_EQ(s.largest_lx, 300);
  EXPECT_DOUBLE_EQ(s.uniformity, 0.5);
  EXPECT_DOUBLE_EQ(s.diversity, 1.0 / 3);
}

TEST(PlaneStatistics, WhereNoPointCountsNothingIsSaid) {
  EXPECT_EQ(StatisticsOf(Eigen::Vector2d(1, 2), {false, false}).points, 0);
  EXPECT_THROW(StatisticsOf(Eigen::Vector2d(1, 2), {true}), std::invalid_argument);
}

// Against the spread of the same statistics over samples of the points' distribution.
TEST(PlaneStatistics, SigmasAreThoseOfMonteCarlo) {
  const Eigen::Vector4d lux(210, 300, 260, 340);
  Eigen::MatrixXd factor(4, 3);
  factor << 4, 1, 0, 6, -2, 1, 5, 0, 2, 7, 1, -1;
  const std::vector<bool> all(4, true);
  const PlaneStatistics s = StatisticsOf(lux, all, factor);
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  constexpr int kSamples = 40'000;
  Eigen::ArrayXd average(kSamples), least(kSamples), uniformity(kSamples);
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector3d z(normal(rng), normal(rng), normal(rng));
    const PlaneStatistics sample = StatisticsOf(lux + factor * z, all);
    average[i] = sample.average_lx;
    least[i] = sample.least_lx;
    uniformity[i] = sample.uniformity;
  }
  const auto sigma = [](const Eigen::ArrayXd& x) { return std::sqrt((x - x.mean()).square().mean()); };
  // 1 / sqrt(2 n) is 0.35 %.
  EXPECT_NEAR(s.average_sigma_lx, sigma(average), 0.015 * s.average_sigma_lx);
  EXPECT_NEAR(s.least_sigma_lx, sigma(least), 0.015 * s.least_sigma_lx);
  EXPECT_NEAR(s.uniformity_sigma, sigma(uniformity), 0.02 * s.uniformity_sigma);
}

TEST(PlaneStatistics, ACommonFactorLeavesUniformityAlone) {
  const Eigen::Vector3d lux(100, 200, 300);
  const PlaneStatistics s = StatisticsOf(lux, {true, true, true}, 0.02 * lux);
  EXPECT_NEAR(s.average_sigma_lx, 4, 1e-12);
  EXPECT_NEAR(s.uniformity_sigma, 0, 1e-12);
}

}  // namespace
}  // namespace luxfit
