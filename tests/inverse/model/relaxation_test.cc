#include "inverse/model/internal/relaxation.h"

#include <gtest/gtest.h>

namespace luxfit {
namespace {

using Eigen::VectorXd;

VectorXd At(double x, double y) { return Eigen::Vector2d(x, y); }

// Takes rounds from x = 1, each of which solves for `next(x)`. Returns where they end.
template <typename Next>
VectorXd AfterRounds(int rounds, const Next& next) {
  Relaxation relaxation;
  VectorXd x = At(1, 0.5), last;
  for (int i = 0; i < rounds; ++i) {
    const VectorXd end = next(x), step = end - x;
    if (last.size() > 0) relaxation.Compare(step, last);
    x = relaxation.PartOf(step, end);
    last = step;
  }
  return x;
}

TEST(Relaxation, TakesWholeStepsThatGoOn) {
  const VectorXd x = AfterRounds(5, [](const VectorXd& at) { return VectorXd(0.5 * at); });
  EXPECT_LT((x - At(1, 0.5) / 32).norm(), 1e-15);
}

// Each round leads to the other side of 0, and a fifth beyond: whole steps go to and fro ever farther.
TEST(Relaxation, SettlesRoundsThatGoToAndFro) {
  const VectorXd x = AfterRounds(12, [](const VectorXd& at) { return VectorXd(-1.2 * at); });
  EXPECT_LT(x.norm(), 1e-3);
}

// A quarter turn a round goes round four states; no step is opposite to the last one.
TEST(Relaxation, TakesStepsAtRightAnglesWhole) {
  const VectorXd x = AfterRounds(4, [](const VectorXd& at) { return At(-at[1], at[0]); });
  EXPECT_LT((x - At(1, 0.5)).norm(), 1e-15);
}

TEST(Relaxation, TakesAnEighthAtLeast) {
  Relaxation relaxation;
  for (int i = 0; i < 10; ++i) relaxation.Compare(At(1, 0), At(-1, 0));
  EXPECT_DOUBLE_EQ(relaxation.PartOf(At(8, 0), At(8, 0))[0], 1);
}

TEST(Relaxation, TakesTheGeometricMeanOfEstimates) {
  Relaxation relaxation;
  EXPECT_DOUBLE_EQ(relaxation.Between(0.01, 0.04), 0.04);
  relaxation.Compare(At(1, 0), At(-1, 0));
  EXPECT_DOUBLE_EQ(relaxation.Between(0.01, 0.04), 0.02);
}

}  // namespace
}  // namespace luxfit
