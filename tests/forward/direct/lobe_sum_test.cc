// Sums over a few points against the closed form of a diffuse rectangle, and lobes about the aim.
#include "forward/direct/internal/lobe_sum.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "forward/direct/internal/surface_rule.h"
#include "forward/factors/internal/polygon_factor.h"
#include "forward/luminaire/luminaire_parts.h"
#include "tests/support/forward/test_lamps.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::kPi;
using support::Lamp;

class FarRectangle : public testing::Test {
 protected:
  // A lamp turned at random, and a receiver `sides` longer sides away in front of it that faces it by more or less.
  void Draw(double sides) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> unit(0, 1);
    const auto vector = [&] { return Eigen::Vector3d(normal(rng_), normal(rng_), normal(rng_)); };
    const double longer = 0.1 + unit(rng_);
    lamp_ = Lamp(Distribution::kLambertian, LuminaireShape::kRectangle, longer,
                 longer * (0.05 + 0.95 * unit(rng_)));
    lamp_.aim = vector().normalized();
    lamp_.heading = vector().normalized();
    Eigen::Vector3d away = vector().normalized();
    if (away.dot(lamp_.aim) < 0) away = -away;
    p_ = lamp_.position + sides * longer * away;
    normal_ = (vector().normalized() - away).normalized();
    facing_lx_ = lamp_.aim.dot(away) / (kPi * std::pow(sides * longer, 2));
  }

  // The closed form, lx per lm, and how it changes as the lamp moves.
  DirectIlluminance Exact() const {
    DirectIlluminance exact;
    const LuminaireAxes axes = AxesOf(lamp_);
    const Eigen::Vector3d u = lamp_.size_m[0] * axes.along, v = lamp_.size_m[1] * axes.across;
    const PolygonGradient factor = PointToPolygonGradient(
        p_, normal_, MakePolygon(lamp_.position - (u + v) / 2, u, v, FacetKind::kParallelogram));
    const double area = lamp_.size_m.prod();
    exact.lx_per_lm = factor.factor / area;
    for (size_t k = 0; k < 4; ++k) exact.d_position += factor.d_vertex[k] / area;
    return exact;
  }

  std::mt19937_64 rng_ = support::TestRng();
  Luminaire lamp_;
  Eigen::Vector3d p_, normal_;
  double facing_lx_ = 0;
};

TEST_F(FarRectangle, IsTheClosedForm) {
  int far = 0, longest_rule = 0, shortest_rule = 100;
  for (int i = 0; i < 5000; ++i) {
    Draw(std::exp(std::uniform_real_distribution<double>(std::log(1.5), std::log(20))(rng_)));
    const LuminousSurface surface(lamp_);
    const auto* rule = FarRuleFor(surface, p_, normal_);
    if (rule == nullptr) continue;
    ++far;
    longest_rule = std::max(longest_rule, static_cast<int>(rule->size()));
    shortest_rule = std::min(shortest_rule, static_cast<int>(rule->size()));
    const DirectIlluminance exact = Exact(), light = LobeSum(surface, p_, normal_, *rule, DiffuseLobe());
    const double distance = (p_ - lamp_.position).norm();
    ASSERT_NEAR(light.lx_per_lm, exact.lx_per_lm, 3e-5 * facing_lx_) << rule->size();
    ASSERT_LT((light.d_position - exact.d_position).norm(), 3e-4 / (kPi * std::pow(distance, 3)))
        << rule->size();
    ASSERT_NEAR(LobeSumLx(surface, p_, normal_, *rule, DiffuseLobe()), light.lx_per_lm, 1e-12 * facing_lx_);
  }
  EXPECT_GT(far, 3000);
  EXPECT_LT(shortest_rule, longest_rule);
}

TEST_F(FarRectangle, IsNotAskedNearByOrWhereTheReceiversPlaneCutsTheLamp) {
  for (int i = 0; i < 100; ++i) {
    Draw(1.2);
    EXPECT_EQ(FarRuleFor(LuminousSurface(lamp_), p_, normal_), nullptr);
    Draw(10);
    const Eigen::Vector3d to_lamp = (lamp_.position - p_).normalized();
    normal_ = to_lamp.unitOrthogonal();  // the plane passes the lamp's centre
    EXPECT_EQ(FarRuleFor(LuminousSurface(lamp_), p_, normal_), nullptr);
    p_.x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(FarRuleFor(LuminousSurface(lamp_), p_, to_lamp), nullptr);
  }
}

TEST_F(FarRectangle, IsDarkBehindTheLamp) {
  Draw(10);
  const Eigen::Vector3d behind = 2 * lamp_.position - p_;
  const LuminousSurface surface(lamp_);
  const Eigen::Vector3d facing = (lamp_.position - behind).normalized();
  const auto* rule = FarRuleFor(surface, behind, facing);
  ASSERT_NE(rule, nullptr);
  EXPECT_EQ(LobeSum(surface, behind, facing, *rule, DiffuseLobe()).lx_per_lm, 0);
  EXPECT_EQ(LobeSumLx(surface, behind, facing, *rule, DiffuseLobe()), 0);
}

// The lobe of one plane, by the angle to the aim, against the table's own intensities by direction.
TEST(OnePlane, IsTheTableByDirection) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  Luminaire lamp = Lamp(Distribution::kMeasured, LuminaireShape::kRectangle, 0.6, 0.3);
  lamp.table = std::make_shared<IntensityTable>(TwoSidedTable(0.3));
  const IntensityAboutAim lobe = AboutAimOf(lamp);
  ASSERT_NE(lobe, nullptr);
  for (int i = 0; i < 1000; ++i) {
    lamp.aim = Eigen::Vector3d(normal(rng), normal(rng), normal(rng)).normalized();
    const LuminaireAxes axes = AxesOf(lamp);
    const Eigen::Vector3d direction = Eigen::Vector3d(normal(rng), normal(rng), normal(rng)).normalized();
    const DirectedIntensity directed = IntensityPerLumen(lamp, axes, direction);
    const Intensity about_aim = lobe(lamp, lamp.aim.dot(direction));
    ASSERT_NEAR(about_aim.cd_per_lm, directed.cd_per_lm, 1e-9);
    // Both as the direction turns towards the aim.
    const Eigen::Vector3d towards = lamp.aim - lamp.aim.dot(direction) * direction;
    ASSERT_NEAR(about_aim.d_cosine * lamp.aim.dot(towards), directed.d_direction.dot(towards), 1e-6);
  }
  lamp.table = support::LopsidedTable();
  EXPECT_EQ(AboutAimOf(lamp), nullptr);
}

}  // namespace
}  // namespace luxfit
