#include "forward/factors/internal/disc_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/closed_forms.h"
#include "tests/support/forward/adaptive_integral.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using Eigen::Vector3d;
using support::kPi;

const Vector3d kUp(0, 0, 1), kDown(0, 0, -1);

// Disc of radius r that faces down at height h, its axis `offset` away. Hamilton and Morgan (1952); Howell's
// catalogue, section B: element parallel to the disc, and at right angles to it, facing its axis.
double Root(double r, double h, double offset) {
  // sqrt((h^2 + offset^2 + r^2)^2 - 4 r^2 offset^2), without its cancellation below the rim.
  return std::sqrt((h * h + (offset - r) * (offset - r)) * (h * h + (offset + r) * (offset + r)));
}
double ParallelFactor(double r, double h, double offset) {
  return 0.5 * (1 - (offset * offset + h * h - r * r) / Root(r, h, offset));
}
double PerpendicularFactor(double r, double h, double offset) {
  return h / (2 * offset) * ((offset * offset + h * h + r * r) / Root(r, h, offset) - 1);
}

TEST(PointToDisc, IsTheCataloguesForWholeDiscs) {
  for (const double r : {0.05, 0.5, 2.0}) {
    for (const double h : {0.01, 0.3, 1.0, 5.0}) {
      EXPECT_NEAR(PointToDisc({0, 0, 0}, kUp, {0, 0, h}, kDown, r).factor / (r * r / (r * r + h * h)), 1,
                  1e-12);
      for (const double offset : {0.01, 0.4, 1.9, 6.0}) {
        const Vector3d center(0.8 * offset, 0.6 * offset, h);
        // As far as the catalogue's difference from 1 is known.
        EXPECT_NEAR(PointToDisc({0, 0, 0}, kUp, center, kDown, r).factor, ParallelFactor(r, h, offset), 1e-14)
            << r << " " << h << " " << offset;
        if (offset <= r) continue;
        EXPECT_NEAR(PointToDisc({0, 0, 0}, {0.8, 0.6, 0}, center, kDown, r).factor,
                    PerpendicularFactor(r, h, offset), 1e-14 * (1 + h / offset))
            << r << " " << h << " " << offset;
      }
    }
  }
}

// From its axis, at right angles: half of it counts, 1/pi int h r cos(phi) / (r^2 + h^2)^2 dA. Beside the
// axis nothing else happens.
TEST(PointToDisc, OfHalfADiscIsItsIntegral) {
  for (const double r : {0.05, 0.5, 2.0}) {
    for (const double h : {0.05, 0.3, 1.0}) {
      const double expected = (std::atan(r / h) - r * h / (r * r + h * h)) / kPi;
      for (const double beside : {0.0, 1e-17, 1e-12, 1e-9}) {
        const DiscFactor disc = PointToDisc({0, beside, 0}, {1, 0, 0}, {0, 0, h}, kDown, r);
        EXPECT_NEAR(disc.factor / expected, 1, 1e-11) << r << " " << h << " " << beside;
        // dF/dh
        const double d_height = -2 * r * r * r / (kPi * (r * r + h * h) * (r * r + h * h));
        EXPECT_NEAR(disc.d_center.z() / d_height, 1, 1e-8) << r << " " << h << " " << beside;
      }
    }
  }
}

TEST(PointToDisc, IsTheDefiningIntegralHoweverThePlaneCutsIt) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  const auto random = [&] { return Vector3d(normal(rng), normal(rng), normal(rng)); };
  int cut = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Vector3d n = random().normalized(), aim = random().normalized(), center = random();
    const double radius = 0.2 + std::abs(normal(rng));
    const double factor = PointToDisc({0, 0, 0}, n, center, aim, radius).factor;
    if (center.dot(aim) > -0.1) continue;  // behind it, or so near its plane that the integral is none
    // Rows along the horizon, so that it bounds the integral.
    const Vector3d across = (n - n.dot(aim) * aim).normalized(), along = aim.cross(across);
    const double horizon = -n.dot(center) / (radius * n.dot(across));
    if (std::abs(horizon) < 1) ++cut;
    const auto row = [&](double t) {
      const double half = radius * std::cos(t);
      return half * half *
             support::AdaptiveIntegral(
                 [&](double u) {
                   const Vector3d d = center + radius * std::sin(t) * across + u * half * along;
                   return -n.dot(d) * aim.dot(d) / (d.squaredNorm() * d.squaredNorm());
                 },
                 -1, 1, 1e-10);
    };
    const double from = horizon >= 1 ? kPi / 2 : std::asin(std::max(horizon, -1.0));
    EXPECT_NEAR(factor, support::AdaptiveIntegral(row, from, kPi / 2, 1e-9) / kPi, 1e-8) << trial;
  }
  EXPECT_GE(cut, 10);
}

TEST(PointToDisc, BehindOrInItsPlaneNothingIsSeenAndNaNStays) {
  EXPECT_EQ(PointToDisc({0, 0, 2}, kDown, {0, 0, 1}, kDown, 0.5).factor, 0);
  EXPECT_EQ(PointToDisc({0, 0, 0}, kDown, {0, 0, 1}, kDown, 0.5).factor, 0);
  for (const double x : {0.0, 0.5, 3.0}) {  // inside, on its rim, outside
    const DiscFactor disc = PointToDisc({x, 0, 1}, kUp, {0, 0, 1}, kDown, 0.5);
    EXPECT_EQ(disc.factor, 0) << x;
    EXPECT_TRUE(disc.d_center.allFinite()) << x;
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(PointToDisc({nan, 0, 0}, kUp, {0, 0, 1}, kDown, 0.5).factor));
  EXPECT_TRUE(std::isnan(PointToDisc({0, 0, 0}, {0, nan, 1}, {0, 0, 1}, kDown, 0.5).factor));
  EXPECT_TRUE(std::isnan(PointToDisc({0, 0, 0}, kUp, {0, 0, 1}, {0, 0, nan}, 0.5).factor));
  EXPECT_TRUE(std::isnan(PointToDisc({0, 0, 0}, kUp, {0, 0, 1}, kDown, nan).factor));
}

}  // namespace
}  // namespace luxfit
