#include "inverse/observe/observe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/support/inverse/simulated_views.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

Observation Seen(int view, double luminance, double variance, int pixels = 10) {
  Observation o;
  o.element = 5;
  o.view = view;
  o.state = 2;
  o.pixels = pixels;
  o.relative_luminance = luminance;
  o.variance = variance;
  return o;
}

TEST(MergeViews, WeighsViewsByTheirVariance) {
  MergeViewsOptions options;
  options.relative_sigma = 0;
  const MergedObservations merged = MergeViews({Seen(0, 1.0, 0.01, 10), Seen(1, 1.3, 0.02, 20)}, options);
  ASSERT_EQ(merged.observations.size(), 1u);
  const Observation& o = merged.observations[0];
  EXPECT_EQ(o.element, 5);
  EXPECT_EQ(o.state, 2);
  EXPECT_EQ(o.view, -1);
  EXPECT_EQ(o.pixels, 30);
  EXPECT_NEAR(o.relative_luminance, (1.0 * 2 + 1.3 * 1) / 3, 1e-12);  // double rounding, here and below
  EXPECT_NEAR(o.variance, 1 / (100. + 50.), 1e-12);
}

TEST(MergeViews, EnlargesEachViewsVariance) {
  MergeViewsOptions options;
  options.relative_sigma = 0.1;
  const MergedObservations merged = MergeViews({Seen(0, 2.0, 0.01)}, options);
  EXPECT_NEAR(merged.observations.at(0).variance, 0.01 + 0.2 * 0.2, 1e-12);  // double rounding
}

TEST(MergeViews, AnOutlierOfThreeIsLeftOut) {
  const MergedObservations three = MergeViews({Seen(0, 1.0, 1e-4), Seen(1, 1.01, 1e-4), Seen(2, 2.0, 1e-4)});
  EXPECT_EQ(three.outliers, 1);
  EXPECT_NEAR(three.observations.at(0).relative_luminance, 1.005, 0.001);  // between the two that agree
  EXPECT_EQ(three.observations.at(0).pixels, 20);
  const MergedObservations two = MergeViews({Seen(0, 1.0, 1e-4), Seen(2, 2.0, 1e-4)});
  EXPECT_EQ(two.outliers, 0);  // of two, nobody knows which
  EXPECT_EQ(two.observations.at(0).pixels, 20);
}

TEST(MergeViews, KeepsElementsAndStatesApart) {
  Observation other_element = Seen(0, 3.0, 1e-4), other_state = Seen(0, 4.0, 1e-4);
  other_element.element = 6;
  other_state.state = 3;
  const MergedObservations merged = MergeViews({Seen(0, 1.0, 1e-4), other_element, other_state});
  ASSERT_EQ(merged.observations.size(), 3u);
  for (const Observation& o : merged.observations) {
    EXPECT_DOUBLE_EQ(o.relative_luminance, o.element == 6 ? 3.0 : o.state == 3 ? 4.0 : 1.0);
  }
}

// Two views at 2 % and 4 % of noise: weights 4 to 1 by noise alone, nearly equal beside a component of 20 %.
TEST(MergeViews, AComponentMakesWeightsAlike) {
  MergeViewsOptions options;
  options.relative_sigma = 0.2;
  const MergedObservations merged = MergeViews({Seen(0, 1.0, 4e-4), Seen(1, 1.1, 16e-4)}, options);
  const double component = std::pow(0.2 * 1.05, 2), first = 1 / (component + 4e-4),
               second = 1 / (component + 16e-4);
  EXPECT_NEAR(merged.observations.at(0).relative_luminance, (first + 1.1 * second) / (first + second), 1e-12);
  EXPECT_NEAR(merged.observations.at(0).variance, 1 / (first + second), 1e-12);
}

TEST(MergeViews, AFewViewsTakeTheDefault) {
  const MergedObservations merged = MergeViews({Seen(0, 1.0, 0)});
  EXPECT_FALSE(merged.between_views.is_estimated);
  EXPECT_NEAR(merged.observations.at(0).variance, 1e-4, 1e-12);  // 1 %
}

TEST(MergeViews, AGivenComponentIsTaken) {
  std::mt19937_64 rng = support::TestRng();
  MergeViewsOptions options;
  options.relative_sigma = 0.03;
  const MergedObservations merged = MergeViews(support::SimulatedViews({}, rng), options);
  EXPECT_EQ(merged.between_views.relative_sigma, 0.03);
  EXPECT_FALSE(merged.between_views.is_estimated);
}

// Merged values scatter about the truth as their variances say, for every size of groups and every component.
TEST(MergeViews, VariancesAreThoseOfMergedValues) {
  std::mt19937_64 rng = support::TestRng();
  for (const double sigma : {0.002, 0.01, 0.05}) {
    support::SimulatedViewsOptions views;
    views.elements = 4000;
    views.relative_sigma = sigma;
    views.relative_noise = 0.5 * sigma;
    views.luminance = 0.7;
    const MergedObservations merged = MergeViews(support::SimulatedViews(views, rng));
    ASSERT_TRUE(merged.between_views.is_estimated);
    ASSERT_EQ(merged.observations.size(), 4000u);
    double squares = 0, sum = 0;
    for (const Observation& o : merged.observations) {
      const double z = (o.relative_luminance - views.luminance) / std::sqrt(o.variance);
      sum += z;
      squares += z * z;
    }
    // Four sigmas: of the mean 4 / sqrt(4000); of the mean square 4 sqrt(2 / 4000) by draws, and as much by s, which 16 000
    // differences tell within 1 %.
    EXPECT_NEAR(sum / 4000, 0, 0.063) << sigma;
    EXPECT_NEAR(squares / 4000, 1, 0.15) << sigma;
  }
}

}  // namespace
}  // namespace luxfit
