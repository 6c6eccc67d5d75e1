#include "forward/luminaire/internal/direction_sampler.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "forward/luminaire/distribution_ops.h"
#include "forward/luminaire/luminaire_parts.h"
#include "tests/support/closed_forms.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

Luminaire Turned(Distribution distribution, double exponent = 1) {
  Luminaire luminaire;
  luminaire.distribution = distribution;
  luminaire.cosine_exponent = exponent;
  luminaire.aim = Eigen::Vector3d(0.3, -0.5, -0.8).normalized();
  luminaire.heading = {0.2, 1, 0.1};
  return luminaire;
}

// Bright between C0 and C90 alone, and up to 60 degrees from the aim.
Luminaire OneQuarter() {
  Luminaire luminaire = Turned(Distribution::kMeasured);
  const double deg = support::kPi / 180;
  const IntensityTable table =
      ExpandPlanes({0, 90 * deg, 180 * deg, 270 * deg}, {0, 30 * deg, 60 * deg, 61 * deg},
                   {2, 3, 1, 0, 2, 2, 1, 0, 2, 0, 0, 0, 2, 0, 0, 0}, PlaneSymmetry::kNone);
  luminaire.table = std::make_shared<IntensityTable>(Normalized(table));
  return luminaire;
}

std::vector<Luminaire> Samples() {
  std::vector<Luminaire> all = {Turned(Distribution::kIsotropic), Turned(Distribution::kLambertian),
                                Turned(Distribution::kCosinePower, 45), OneQuarter(),
                                Turned(Distribution::kMeasured)};
  all.back().table = std::make_shared<IntensityTable>(TwoSidedTable(0.3));
  return all;
}

Eigen::Vector3d EvenDirection(std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(rng), normal(rng), normal(rng)).normalized();
}

// Mean of f(w) / q(w) over drawn directions is the integral of f. f = q at even directions of the sphere is 1 on the
// other way. Both would tell of a density that is not that of the draws.
TEST(DirectionSampler, TheDensityIsThatOfTheDraws) {
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int kDraws = 200000;
  for (const Luminaire& luminaire : Samples()) {
    const DirectionSampler sampler(luminaire);
    const LuminaireAxes axes = AxesOf(luminaire);
    double flux = 0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero(), expected = mean;
    double evenly = 0;
    for (int i = 0; i < kDraws; ++i) {
      const Eigen::Vector3d drawn = sampler.DirectionAt({unit(rng), unit(rng)});
      ASSERT_NEAR(drawn.norm(), 1, 1e-12);
      ASSERT_GT(sampler.Density(drawn), 0);
      flux += IntensityPerLumen(luminaire, axes, drawn).cd_per_lm / sampler.Density(drawn) / kDraws;
      mean += drawn / kDraws;
      const Eigen::Vector3d even = EvenDirection(rng);
      evenly += 4 * support::kPi * sampler.Density(even) / kDraws;
      expected += 4 * support::kPi * sampler.Density(even) * even / kDraws;
    }
    // 1 lm: cells follow the intensity, so that the ratio hardly varies. Cells whose centre is dark lack 0.5 % at most.
    EXPECT_NEAR(flux, 1, 0.005) << ToString(luminaire.distribution);
    // Even directions seldom meet a lobe of exponent 45: their standard error is 1.1 %.
    EXPECT_NEAR(evenly, 1, 0.04) << ToString(luminaire.distribution);
    EXPECT_LT((mean - expected).norm(), 0.04) << ToString(luminaire.distribution);
  }
}

TEST(DirectionSampler, FollowsTheIntensity) {
  std::mt19937_64 rng = support::TestRng();
  for (const Luminaire& luminaire : Samples()) {
    const DirectionSampler sampler(luminaire);
    const LuminaireAxes axes = AxesOf(luminaire);
    double squares = 0, norm = 0;
    for (int i = 0; i < 50000; ++i) {
      const Eigen::Vector3d even = EvenDirection(rng);
      const double intensity = IntensityPerLumen(luminaire, axes, even).cd_per_lm;
      squares += std::pow(sampler.Density(even) - intensity, 2);
      norm += intensity * intensity;
    }
    // Half a cell, 0.25 or 2.5 degrees, of a table that falls to 0 within a degree.
    EXPECT_LT(std::sqrt(squares / norm), luminaire.distribution == Distribution::kMeasured ? 0.1 : 0.02)
        << ToString(luminaire.distribution);
  }
}

// The bands' centres are dark to the last digit of a double.
TEST(DirectionSampler, ALobeNarrowerThanItsCellsHasNoDensity) {
  const Luminaire needle = Turned(Distribution::kCosinePower, 1e9);
  const DirectionSampler sampler(needle);
  EXPECT_EQ(sampler.Density(needle.aim), 0);
  EXPECT_NEAR(sampler.DirectionAt({0.5, 0.5}).norm(), 1, 1e-12);
}

}  // namespace
}  // namespace luxfit
