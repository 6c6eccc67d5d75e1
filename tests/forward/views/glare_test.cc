#include "forward/views/glare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "forward/room/scene.h"
#include "tests/support/closed_forms.h"

namespace luxfit {
namespace {

using support::kPi;

const Observer kObserver{{0, 0, 1.2}, {1, 0, 0}};

Eigen::Vector3d Towards(double height_over_distance, double side_over_distance) {
  return Eigen::Vector3d(1, side_over_distance, height_over_distance).normalized();
}

// Entries of table 4.1 of CIE 117-1995 (height and side over distance, index).
TEST(Glare, PositionIndexIsThatOfTheTable) {
  const std::tuple<double, double, double> table[] = {
      {0.0, 0, 1.00}, {0.1, 0, 1.26}, {0.2, 0, 1.53}, {0.3, 0, 1.90},   {0.5, 0, 2.86},
      {0.7, 0, 4.20}, {1.0, 0, 7.00}, {1.2, 0, 9.25}, {0.5, 0.1, 2.75}, {1.0, 0.2, 6.50}};
  for (const auto& [height, side, index] : table) {
    // The formula is within 5 % of Guth's diagram over most of it, 12 % at most (Levin 1975).
    EXPECT_NEAR(PositionIndex(kObserver, Towards(height, side)), index, 0.06 * index)
        << height << " " << side;
  }
}

TEST(Glare, PositionIndexIsAlikeOnBothSidesAndContinuousAtTheLineOfSight) {
  EXPECT_NEAR(PositionIndex(kObserver, Towards(0.4, 0.7)), PositionIndex(kObserver, Towards(0.4, -0.7)),
              1e-12);
  EXPECT_NEAR(PositionIndex(kObserver, Towards(0, 0)), 1, 1e-12);
  EXPECT_NEAR(PositionIndex(kObserver, Towards(-1e-9, 0)), 1, 1e-6);
}

TEST(Glare, WhatTheTableLeavesOutDoesNotCount) {
  EXPECT_TRUE(std::isinf(PositionIndex(kObserver, Towards(2.0, 0))));  // hidden by the brow
  EXPECT_TRUE(std::isinf(PositionIndex(kObserver, Towards(0.2, 3.1))));
  EXPECT_TRUE(std::isinf(PositionIndex(kObserver, Eigen::Vector3d(-1, 0, 0))));
}

// DGP's index is the same, and goes on where CIE 117's table ends.
TEST(Glare, TheIndexOfTheHemisphereGoesOnBeyondTheTable) {
  for (const auto& [height, side] : {std::pair{0.5, 0.1}, {1.0, 0.2}, {0.0, 2.0}, {-0.4, 0.3}, {-1.0, 2.0}})
    EXPECT_EQ(HemisphereIndex(kObserver, Towards(height, side)),
              PositionIndex(kObserver, Towards(height, side)));
  EXPECT_GT(HemisphereIndex(kObserver, Towards(2.0, 0)), 15);
  EXPECT_EQ(HemisphereIndex(kObserver, Towards(50, 0)), 16);
  EXPECT_NEAR(HemisphereIndex(kObserver, Towards(-50, 0)), 1 + 1.2 * 3, 1e-12);
  EXPECT_TRUE(std::isinf(HemisphereIndex(kObserver, Eigen::Vector3d(-1, 0, 0))));
}

// By hand, E_v = 3000 lx: 0.1761 + 0.0918 log10(1 + 1e8 / 3000^1.87) + 0.16, 3000^1.87 = 3.1784e6.
TEST(Glare, DaylightGlareProbabilityByHand) {
  EXPECT_NEAR(DaylightGlareProbability(1e8, 3000), 0.1761 + 0.0918 * std::log10(1 + 100 / 3.1784) + 0.16,
              1e-5);
  EXPECT_NEAR(DaylightGlareProbability(0, 2000), 0.1174 + 0.16, 1e-12);
  EXPECT_EQ(DaylightGlareProbability(1e12, 30000), 1);
  // In little light nobody is dazzled: exp(0.024 * 200 - 4) = 2.22554.
  EXPECT_NEAR(DaylightGlareProbability(0, 200), (0.01174 + 0.16) * 2.22554 / 3.22554, 1e-6);
  EXPECT_THROW(DaylightGlareProbability(1, 0), std::invalid_argument);
}

Luminaire Panel(const Eigen::Vector3d& position, double side_m, double flux_lm) {
  Luminaire panel;
  panel.position = position;
  panel.aim = Eigen::Vector3d(-1, 0, 0);
  panel.heading = Eigen::Vector3d(0, 1, 0);
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = {side_m, side_m};
  panel.flux_lm = flux_lm;
  return panel;
}

// A small Lambertian panel that faces the eye 4 m away, 1 m up: by hand
//   A = 0.04 m2, Phi = 1000 lm: L = Phi / (pi A) = 7957.7 cd/m2;   r2 = 17 m2, cos = 4 / sqrt(17)
//   omega = A cos / r2 = 0.0022827 sr;   p (H/R = 0.25, T = 0) by the formula;   L_b = 30 cd/m2
TEST(Glare, OnePanelByHand) {
  const RayScene rays{Scene{}};
  const GlareSource source = GlareOf(rays, Panel({4, 0, 2.2}, 0.2, 1000), kObserver);
  const double luminance = 1000 / (kPi * 0.04), solid_angle = 0.04 * 4 / std::pow(17, 1.5);
  const double sigma = std::atan(0.25) * 180 / kPi;
  const double index = std::exp((35.2 - 1.22) * 1e-3 * sigma + 21e-5 * sigma * sigma);
  EXPECT_NEAR(source.luminance_cd_m2, luminance, 1e-6 * luminance);
  EXPECT_NEAR(source.solid_angle_sr, solid_angle,
              2e-3 * solid_angle);  // its corners are farther than its middle
  const double sum = luminance * luminance * solid_angle / (index * index);
  EXPECT_NEAR(source.sum, sum, 0.01 * sum);  // p is not quite the same all over it
  EXPECT_NEAR(UnifiedGlareRating(source.sum, 30), 8 * std::log10(0.25 / 30 * sum), 0.04);
}

// L^2 omega p^-2 is linear in solid angle: a panel is the sum of its quarters, wherever it is.
TEST(Glare, APanelIsTheSumOfItsQuarters) {
  const RayScene rays{Scene{}};
  const double whole = GlareOf(rays, Panel({3, 0.5, 2.0}, 0.6, 4000), kObserver, 16).sum;
  double quarters = 0;
  for (const double y : {-0.15, 0.15}) {
    for (const double z : {-0.15, 0.15})
      quarters += GlareOf(rays, Panel({3, 0.5 + y, 2.0 + z}, 0.3, 1000), kObserver, 8).sum;
  }
  EXPECT_NEAR(whole, quarters, 1e-6 * whole);
}

// One half of it dark: half the area at twice the luminance.
TEST(Glare, AnUnevenPanelIsThatOfItsBrightHalf) {
  const RayScene rays{Scene{}};
  Luminaire uneven = Panel({3, 0, 2.0}, 0.4, 1000);
  uneven.emission.resize(2, 1);
  uneven.emission << 1, 0;
  Luminaire half = Panel({3, -0.1, 2.0}, 0.4, 1000);
  half.size_m = {0.2, 0.4};
  const double want = GlareOf(rays, half, kObserver, 16).sum;
  EXPECT_NEAR(GlareOf(rays, uneven, kObserver, 16).sum, want, 1e-3 * want);
}

TEST(Glare, AnOccluderHidesASource) {
  Scene scene;
  scene.materials = {"screen"};
  scene.facets = FacetsFromPolygon({{2, -5, -5}, {2, 5, -5}, {2, 5, 5}, {2, -5, 5}}, 0);
  const GlareSource source = GlareOf(RayScene(scene), Panel({4, 0, 2.2}, 0.2, 1000), kObserver);
  EXPECT_EQ(source.sum, 0);
  EXPECT_EQ(source.solid_angle_sr, 0);
}

TEST(Glare, ASphereIsAsBrightAllOver) {
  Luminaire globe;
  globe.position = {3, 0, 2.2};
  globe.shape = LuminaireShape::kSphere;
  globe.size_m = {0.3, 0.3};
  globe.distribution = Distribution::kIsotropic;
  globe.flux_lm = 900;
  const GlareSource source = GlareOf(RayScene(Scene{}), globe, kObserver);
  const double luminance = 900 / (4 * kPi) / (kPi * 0.15 * 0.15);
  EXPECT_NEAR(source.luminance_cd_m2, luminance, 1e-9 * luminance);
  EXPECT_NEAR(source.solid_angle_sr, kPi * 0.15 * 0.15 / 10, 1e-12);
}

TEST(Glare, APointHasNoLuminance) {
  EXPECT_FALSE(GlareOf(RayScene(Scene{}), Luminaire{}, kObserver).is_defined);
  EXPECT_THROW(UnifiedGlareRating(1, 0), std::invalid_argument);
  EXPECT_TRUE(std::isinf(UnifiedGlareRating(0, 10)));
}

}  // namespace
}  // namespace luxfit
