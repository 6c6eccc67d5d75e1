#include "inverse/observe/internal/view_difference.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "inverse/observe/internal/photo_offsets.h"
#include "inverse/observe/internal/view_table.h"
#include "tests/support/inverse/simulated_views.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

Observation Seen(int view, int state, double luminance, double variance) {
  Observation o;
  o.view = view, o.state = state;
  o.relative_luminance = luminance;
  o.variance = variance;
  return o;
}

// States 0 to 2 of views 0 and 3; view 3 lacks state 1.
ViewTable SmallTable() {
  return TableOfViews({Seen(0, 0, 1, 1e-4), Seen(0, 1, 2, 4e-4), Seen(0, 2, 0.5, 1e-4), Seen(3, 0, 1.2, 2e-4),
                       Seen(3, 2, 0.55, 3e-4)});
}

TEST(ViewDifference, OnlyStatesThatBothShow) {
  const ViewDifference d = DifferenceOf(SmallTable(), 0, 1);
  ASSERT_EQ(d.states, 2);
  EXPECT_NEAR(d.value[0], std::log(1 / 1.2), 1e-12);  // double rounding, here and below
  EXPECT_NEAR(d.value[1], std::log(0.5 / 0.55), 1e-12);
  EXPECT_NEAR(d.noise[1], 1e-4 / 0.25 + 3e-4 / 0.3025, 1e-12);
  EXPECT_NEAR(d.common, d.value.mean(), 1e-12);
  EXPECT_NEAR(d.common_noise, d.noise.sum() / 4, 1e-12);
}

TEST(ViewDifference, DensityIsThatOfTheWholeCovariance) {
  const ViewDifference d = DifferenceOf(SmallTable(), 0, 1);
  constexpr double kCommon = 3e-3, kState = 5e-4;
  const Eigen::MatrixXd covariance =
      Eigen::MatrixXd((d.noise + kState).matrix().asDiagonal()) + kCommon * Eigen::MatrixXd::Ones(2, 2);
  const Eigen::VectorXd value = d.value.matrix();
  const double expected =
      -0.5 * (value.dot(covariance.inverse() * value) + std::log(covariance.determinant()));
  EXPECT_NEAR(LogDensity(d, kCommon, kState), expected, 1e-9 * std::abs(expected));
}

// One photo is 5 % too bright, and a third of the elements show something else in one view. Its offset and the others'
// have the mean 0. Tolerance: four standard errors of a median over 300 elements that scatter by 1 %.
TEST(PhotoOffsets, APhotoThatIsTooBrightIsFound) {
  std::mt19937_64 rng = support::TestRng();
  support::SimulatedViewsOptions options;
  options.elements = 300;
  options.min_views = options.max_views = 6;
  options.outlier_share = 0.3;
  std::vector<Observation> observations = support::SimulatedViews(options, rng);
  for (Observation& o : observations) o.relative_luminance *= o.view == 2 ? 1.05 : 1;
  const Eigen::ArrayXXd offset = PhotoOffsets(TableOfViews(observations));
  ASSERT_EQ(offset.cols(), 6);
  const double mean = std::log(1.05) / 6;
  for (Eigen::Index v = 1; v < 6; ++v) EXPECT_NEAR(offset(0, v), (v == 2 ? std::log(1.05) : 0) - mean, 0.003);
}

TEST(PhotoOffsets, FewElementsTellNothing) {
  std::mt19937_64 rng = support::TestRng();
  support::SimulatedViewsOptions options;
  options.elements = 20;
  EXPECT_EQ(PhotoOffsets(TableOfViews(support::SimulatedViews(options, rng))).abs().maxCoeff(), 0);
}

}  // namespace
}  // namespace luxfit
