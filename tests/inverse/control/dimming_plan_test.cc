#include "inverse/control/dimming.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

LightRequirement AtLeast(const Eigen::VectorXd& light, double least) { return {"E", light, least}; }

// The least power over a grid of dimmings that meets everything; infinity where none does.
double BruteForce(const Eigen::VectorXd& power, const std::vector<LightRequirement>& requirements,
                  int steps) {
  double least = std::numeric_limits<double>::infinity();
  const int count = static_cast<int>(power.size());
  const int points = static_cast<int>(std::pow(steps + 1, count));
  for (int i = 0; i < points; ++i) {
    Eigen::VectorXd d(count);
    int rest = i;
    for (int k = 0; k < count; ++k, rest /= steps + 1) d[k] = static_cast<double>(rest % (steps + 1)) / steps;
    bool meets = true;
    for (const LightRequirement& r : requirements) {
      const double value = r.light.dot(d);
      meets = meets && value >= r.least - 1e-9 && value <= r.most + 1e-9;
    }
    if (meets) least = std::min(least, power.dot(d));
  }
  return least;
}

TEST(DimmingPlan, TakesTheLuminaireThatGivesMostLightForItsPower) {
  const DimmingPlan plan =
      PlanDimming(Eigen::Vector2d(10, 10), {AtLeast(Eigen::Vector2d(100, 300), 150)}, FullRange(2));
  EXPECT_TRUE(plan.is_reached);
  EXPECT_NEAR(plan.dimming[0], 0, 1e-9);
  EXPECT_NEAR(plan.dimming[1], 0.5, 1e-9);
  EXPECT_NEAR(plan.power_w, 5, 1e-9);
}

TEST(DimmingPlan, IsNoWorseThanAnyPointOfAGridAndNotFarBelowTheBest) {
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> uniform(0, 1);
  constexpr int kSteps = 20;
  int compared = 0;
  for (int trial = 0; trial < 15; ++trial) {
    Eigen::VectorXd power(3);
    for (double& p : power) p = 5 + 30 * uniform(rng);
    std::vector<LightRequirement> requirements;
    for (int i = 0; i < 4; ++i) {
      Eigen::VectorXd light(3);
      for (double& e : light) e = 200 * uniform(rng);
      requirements.push_back(AtLeast(light, 0.6 * uniform(rng) * light.sum()));
    }
    const DimmingPlan plan = PlanDimming(power, requirements, FullRange(3));
    const double grid_w = BruteForce(power, requirements, kSteps);
    ASSERT_TRUE(plan.is_reached);
    ++compared;
    EXPECT_LE(plan.power_w, grid_w + 1e-6);
    // Rounding every level up to the grid stays feasible and costs at most one step each.
    EXPECT_GE(plan.power_w, grid_w - power.sum() / kSteps - 1e-6);
  }
  EXPECT_EQ(compared, 15);
}

TEST(DimmingPlan, SaysWhereAndHowMuchIsLacking) {
  const DimmingPlan plan = PlanDimming(
      Eigen::Vector2d(10, 10), {AtLeast(Eigen::Vector2d(100, 50), 120), AtLeast(Eigen::Vector2d(10, 20), 50)},
      FullRange(2));
  EXPECT_FALSE(plan.is_reached);
  EXPECT_NEAR(plan.shortage[1], 20, 1e-6);
  EXPECT_NEAR(plan.shortage[0], 0, 1e-6);
}

TEST(DimmingPlan, KeepsUniformityAndUpperBounds) {
  // Two points, two luminaires over one each: only both together are even.
  const Eigen::Vector2d a(100, 20), b(20, 100);
  const Eigen::Vector2d mean = 0.5 * (a + b);
  const std::vector<LightRequirement> requirements{
      {"E_avg", mean, 40}, {"U0 a", a - 0.9 * mean, 0}, {"U0 b", b - 0.9 * mean, 0}, {"glare", a, 0, 60}};
  const DimmingPlan plan = PlanDimming(Eigen::Vector2d(10, 30), requirements, FullRange(2));
  ASSERT_TRUE(plan.is_reached);
  const double at_a = a.dot(plan.dimming), at_b = b.dot(plan.dimming);
  EXPECT_GE(std::min(at_a, at_b), 0.9 * 0.5 * (at_a + at_b) - 1e-6);
  EXPECT_LE(at_a, 60 + 1e-6);
  EXPECT_NEAR(0.5 * (at_a + at_b), 40, 1e-6);
}

TEST(DimmingPlan, MarginAsksForMoreWhereLessIsKnown) {
  const LightRequirement asked = AtLeast(Eigen::Vector2d(100, 100), 50);
  const LightRequirement sure = WithMargin(asked, Eigen::Vector2d(0.02, 0.1));
  EXPECT_NEAR(sure.light[0], 100 * (1 - 1.645 * 0.02), 1e-9);
  EXPECT_NEAR(sure.light[1], 100 * (1 - 1.645 * 0.1), 1e-9);
}

TEST(DimmingPlan, RefusesSizesThatDoNotFit) {
  EXPECT_THROW(PlanDimming(Eigen::Vector2d(1, 1), {AtLeast(Eigen::Vector3d(1, 1, 1), 1)}, FullRange(2)),
               std::invalid_argument);
  EXPECT_THROW(PlanDimming(Eigen::Vector2d(1, -1), {}, FullRange(2)), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
