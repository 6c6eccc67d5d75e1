#include "inverse/observe/internal/between_views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/support/inverse/simulated_views.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::SimulatedViews;
using support::SimulatedViewsOptions;

constexpr double kSigmas[] = {0.002, 0.01, 0.05};

SimulatedViewsOptions ViewsOf(double relative_sigma, double noise_ratio) {
  SimulatedViewsOptions views;
  views.relative_sigma = relative_sigma;
  views.relative_noise = noise_ratio * relative_sigma;
  return views;
}

double EstimateFrom(const SimulatedViewsOptions& views, std::mt19937_64& rng) {
  const BetweenViews found = EstimateBetweenViews(SimulatedViews(views, rng));
  EXPECT_TRUE(found.is_estimated);
  return found.relative_sigma;
}

// Returns the options for groups of one size, with 16 000 views in all.
SimulatedViewsOptions WithSize(SimulatedViewsOptions views, int size) {
  views.min_views = views.max_views = size;
  views.elements = 16'000 / size;
  return views;
}

// Tolerances: about four times the scatter of estimates over draws. It is 1 to 3 % where noise is at most half of the
// component, largest for groups of two.
TEST(BetweenViews, TheComponentIsRecoveredFromGroupsOfEverySize) {
  std::mt19937_64 rng = support::TestRng();
  for (const double sigma : kSigmas) {
    for (const double noise : {0.0, 0.5}) {
      for (int size = 2; size <= 8; ++size) {
        const SimulatedViewsOptions views = WithSize(ViewsOf(sigma, noise), size);
        EXPECT_NEAR(EstimateFrom(views, rng) / sigma, 1, 0.12) << sigma << " " << noise << " " << size;
      }
    }
  }
}

TEST(BetweenViews, TheComponentIsRecoveredFromMixedGroups) {
  std::mt19937_64 rng = support::TestRng();
  for (const double sigma : kSigmas)
    EXPECT_NEAR(EstimateFrom(ViewsOf(sigma, 0.5), rng) / sigma, 1, 0.05) << sigma;
}

TEST(BetweenViews, NoiseAsLargeAsTheComponentIsSubtracted) {
  std::mt19937_64 rng = support::TestRng();
  for (const double sigma : kSigmas)
    EXPECT_NEAR(EstimateFrom(ViewsOf(sigma, 1), rng) / sigma, 1, 0.12) << sigma;
}

// In groups of two, 30 % of outlying elements are 30 % of all pairs. A median over all pairs would be 58 % too large.
TEST(BetweenViews, ThreeOutliersOfTenElementsHardlyMatter) {
  std::mt19937_64 rng = support::TestRng();
  for (const double sigma : kSigmas) {
    for (const int size : {2, 3, 5, 8}) {
      SimulatedViewsOptions views = WithSize(ViewsOf(sigma, 0.5), size);
      views.outlier_share = 0.3;
      EXPECT_NEAR(EstimateFrom(views, rng) / sigma, 1, 0.25) << sigma << " " << size;
    }
  }
}

TEST(BetweenViews, ViewsThatAgreeGiveTheLeastComponent) {
  std::mt19937_64 rng = support::TestRng();
  SimulatedViewsOptions exact = ViewsOf(0, 0);
  EXPECT_EQ(EstimateFrom(exact, rng), 1e-3);
  exact.relative_noise = 1e-6;
  EXPECT_EQ(EstimateFrom(exact, rng), 1e-3);
}

// Pixels of textured elements spread more than their noise: views then agree better than their variances say.
TEST(BetweenViews, OverstatedNoiseGivesTheLeastComponent) {
  std::mt19937_64 rng = support::TestRng();
  std::vector<Observation> views = SimulatedViews(ViewsOf(0.005, 0), rng);
  for (Observation& o : views) o.variance = std::pow(0.02 * o.relative_luminance, 2);
  EXPECT_EQ(EstimateBetweenViews(views).relative_sigma, 1e-3);
}

TEST(BetweenViews, TheUnitOfLuminanceDoesNotMatter) {
  std::mt19937_64 rng = support::TestRng();
  std::vector<Observation> views = SimulatedViews(ViewsOf(0.01, 0.5), rng);
  const double before = EstimateBetweenViews(views).relative_sigma;
  for (Observation& o : views) {
    o.relative_luminance *= 1024;  // a power of two: without rounding
    o.variance *= 1024.0 * 1024.0;
  }
  EXPECT_EQ(EstimateBetweenViews(views).relative_sigma, before);
}

TEST(BetweenViews, TooFewSharedElementsGiveTheDefault) {
  std::mt19937_64 rng = support::TestRng();
  SimulatedViewsOptions views = ViewsOf(0.05, 0);
  views.elements = 29;
  const BetweenViews few = EstimateBetweenViews(SimulatedViews(views, rng));
  EXPECT_FALSE(few.is_estimated);
  EXPECT_EQ(few.groups, 29);
  EXPECT_EQ(few.relative_sigma, 0.01);
  views.elements = 30;
  EXPECT_TRUE(EstimateBetweenViews(SimulatedViews(views, rng)).is_estimated);
}

TEST(BetweenViews, OneViewGivesTheDefault) {
  std::mt19937_64 rng = support::TestRng();
  SimulatedViewsOptions views = ViewsOf(0.05, 0);
  views.min_views = views.max_views = 1;
  const BetweenViews one = EstimateBetweenViews(SimulatedViews(views, rng));
  EXPECT_FALSE(one.is_estimated);
  EXPECT_EQ(one.groups, 0);
  EXPECT_EQ(one.relative_sigma, 0.01);
  EXPECT_EQ(EstimateBetweenViews({}).relative_sigma, 0.01);
}

TEST(BetweenViews, PhotosOfOneViewTellNothing) {
  std::mt19937_64 rng = support::TestRng();
  std::vector<Observation> photos = SimulatedViews(ViewsOf(0.05, 0), rng);
  for (Observation& o : photos) o.view = 0;
  EXPECT_FALSE(EstimateBetweenViews(photos).is_estimated);
}

}  // namespace
}  // namespace luxfit
