#include "inverse/select/internal/robust_rows.h"

#include <gtest/gtest.h>

#include <cmath>

namespace luxfit {
namespace {

// Differences of three unknowns, 0.3, -0.1 and -0.2, of which the prior holds the mean; two of five rows stray to one side.
RobustRows Differences() {
  const Eigen::Vector3d truth(0.3, -0.1, -0.2);
  RobustRows rows;
  for (int i = 0; i < 300; ++i) {
    const int a = i % 3, b = (i + 1) % 3;
    const double noise = 0.003 * std::sin(1.7 * i), stray = i % 5 < 2 ? 0.2 + 0.01 * (i % 11) : 0;
    rows.Add({{a, 1}, {b, -1}}, truth[a] - truth[b] + noise + stray, 1, i);
  }
  return rows;
}

TEST(RobustRowsTest, StraysOnOneSideMoveNothing) {
  const Eigen::VectorXd x = Differences().Solve(0, 0.5, 3, -1);
  EXPECT_NEAR(x[0], 0.3, 0.002);
  EXPECT_NEAR(x[1], -0.1, 0.002);
  EXPECT_NEAR(x.sum(), 0, 1e-6);  // what no row tells
}

TEST(RobustRowsTest, AFoldIsLeftOut) {
  RobustRows rows;
  rows.Add({{0, 1}}, 1, 0.01, 0);
  rows.Add({{0, 1}}, 2, 0.01, 1);
  EXPECT_NEAR(rows.Solve(0, 10, 1, 0)[0], 2, 1e-3);
  EXPECT_NEAR(rows.Solve(0, 10, 1, 1)[0], 1, 1e-3);
}

TEST(RobustRowsTest, RowsOfTwoAreThoseOfOne) {
  RobustRows both = Differences(), rest;
  rest.Add({{0, 2}, {1, 1}}, 7, 0.5, 12);
  both.Add(rest);
  EXPECT_EQ(both.count(), 301U);
  EXPECT_EQ(both.GroupOf(300), 12);
  EXPECT_NEAR(both.Residual(300, Eigen::Vector3d(1, 2, 0)), (7 - 2 - 2) / 0.5, 1e-12);
  EXPECT_GT(Differences().NoiseAt(Eigen::Vector3d(0.3, -0.1, -0.2)), 0.002);
}

TEST(RobustRowsTest, WithoutRowsThePriorStands) {
  EXPECT_NEAR(RobustRows().Solve(0.7, 0.1, 2, -1)[1], 0.7, 1e-12);
}

}  // namespace
}  // namespace luxfit
