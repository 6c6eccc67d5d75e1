#include "forward/luminaire/photometry.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

#include "tests/support/closed_forms.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::kPi;

std::vector<double> Steps(double first_deg, double last_deg, double step_deg) {
  std::vector<double> rad;
  for (int i = 0; first_deg + i * step_deg <= last_deg + 1e-9; ++i)
    rad.push_back((first_deg + i * step_deg) * kPi / 180);
  return rad;
}

std::vector<double> Fill(const std::vector<double>& c_rad, const std::vector<double>& gamma_rad,
                         const std::function<double(double, double)>& intensity) {
  std::vector<double> values;
  for (const double c : c_rad) {
    for (const double g : gamma_rad) values.push_back(intensity(c, g));
  }
  return values;
}

Eigen::Vector3d Direction(double c_deg, double gamma_deg) {
  const double c = c_deg * kPi / 180, g = gamma_deg * kPi / 180;
  return {std::sin(g) * std::cos(c), std::sin(g) * std::sin(c), -std::cos(g)};
}

// No symmetry at all, smooth on the sphere, never 0.
double Lopsided(double c, double g) {
  return 2 + std::sin(g) * (std::cos(c) + 0.5 * std::sin(c)) + 0.4 * std::cos(g);
}

IntensityTable LopsidedTable(double c_step_deg = 15, double gamma_step_deg = 5) {
  const std::vector<double> c = Steps(0, 360 - c_step_deg, c_step_deg), g = Steps(0, 180, gamma_step_deg);
  return ExpandPlanes(c, g, Fill(c, g, Lopsided), PlaneSymmetry::kNone);
}

TEST(FluxIntegral, IsExactForTheInterpolant) {
  // I = 1: 4 pi. I = gamma, linear as the interpolant is: 2 pi int g sin g dg = 2 pi^2.
  const std::vector<double> coarse{0, 1.1, 2.5, kPi};
  const IntensityTable one = ExpandPlanes({0}, coarse, {1, 1, 1, 1}, PlaneSymmetry::kRotational);
  EXPECT_NEAR(FluxIntegral(one), 4 * kPi, 1e-13);  // double rounding
  const IntensityTable linear = ExpandPlanes({0}, coarse, coarse, PlaneSymmetry::kRotational);
  EXPECT_NEAR(FluxIntegral(linear), 2 * kPi * kPi, 1e-13);
}

TEST(FluxIntegral, IsTheMeanOverTheSphere) {
  const IntensityTable table = LopsidedTable(45, 30);
  // Midpoint rule over cos gamma and C; kinks at the table's angles: error of the order of one cell squared.
  constexpr int kBands = 600, kSectors = 360;
  double mean = 0;
  for (int i = 0; i < kBands; ++i) {
    const double z = -1 + (i + 0.5) * 2 / kBands;
    for (int j = 0; j < kSectors; ++j)
      mean += IntensityTowards(table, Direction(j + 0.5, std::acos(-z) * 180 / kPi)).cd_per_lm;
  }
  EXPECT_NEAR(FluxIntegral(table) / (4 * kPi * mean / (kBands * kSectors)), 1, 1e-5);
}

TEST(FluxIntegral, OfALambertianIsPiAsTheStepShrinks) {
  for (const double step_deg : {10.0, 5.0, 1.0}) {
    const std::vector<double> g = Steps(0, 90, step_deg);
    const IntensityTable table =
        ExpandPlanes({0}, g, Fill({0}, g, [](double, double x) { return std::max(0.0, std::cos(x)); }),
                     PlaneSymmetry::kRotational);
    const double h = step_deg * kPi / 180;
    EXPECT_NEAR(FluxIntegral(table) / kPi, 1 - h * h / 12, 1e-4 * h) << step_deg;  // linear interpolation
  }
}

TEST(IntensityTowards, KnowsWhereC90Is) {
  const std::vector<double> c = Steps(0, 270, 90), g{0, kPi / 2, kPi};
  const IntensityTable table = ExpandPlanes(
      c, g, Fill(c, g, [](double x, double) { return 1 + x / (kPi / 2); }), PlaneSymmetry::kNone);
  EXPECT_NEAR(IntensityTowards(table, {1, 0, 0}).cd_per_lm, 1, 1e-12);
  EXPECT_NEAR(IntensityTowards(table, {0, 1, 0}).cd_per_lm, 2, 1e-12);  // +y: counter-clockwise from above
  EXPECT_NEAR(IntensityTowards(table, {-1, 0, 0}).cd_per_lm, 3, 1e-12);
  EXPECT_NEAR(IntensityTowards(table, {0, -1, 0}).cd_per_lm, 4, 1e-12);
}

TEST(IntensityTowards, IsContinuousWhereTheCircleCloses) {
  const IntensityTable table = LopsidedTable();
  for (const double gamma : {1.0, 44.0, 90.0, 179.0}) {
    const double before = IntensityTowards(table, Direction(-1e-7, gamma)).cd_per_lm;
    const double after = IntensityTowards(table, Direction(1e-7, gamma)).cd_per_lm;
    EXPECT_NEAR(before, after, 1e-8);
  }
}

TEST(IntensityTowards, IsTheFunctionWithinTheInterpolationError) {
  const IntensityTable table = LopsidedTable(5, 2.5);
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 300; ++i) {
    const double c = 360 * unit(rng), g = 180 * unit(rng);
    const double expected = Lopsided(c * kPi / 180, g * kPi / 180);
    // h^2 / 8 of the second derivatives, which are at most 1.2: 5 deg is 0.087 rad.
    EXPECT_NEAR(IntensityTowards(table, Direction(c, g)).cd_per_lm, expected, 1.2 * 0.087 * 0.087 / 4);
  }
}

TEST(IntensityTowards, IsDarkOutsideTheTable) {
  const std::vector<double> g = Steps(0, 90, 30);
  const IntensityTable down = ExpandPlanes({0}, g, {1, 1, 1, 1}, PlaneSymmetry::kRotational);
  EXPECT_EQ(IntensityTowards(down, Direction(10, 90.001)).cd_per_lm, 0);
  EXPECT_EQ(IntensityTowards(down, Direction(10, 89.999)).cd_per_lm, 1);
  const IntensityTable sector = ExpandPlanes({0, 1}, g, std::vector<double>(8, 1), PlaneSymmetry::kPartial);
  EXPECT_EQ(IntensityTowards(sector, Direction(-1, 45)).cd_per_lm, 0);
  EXPECT_EQ(IntensityTowards(sector, Direction(58, 45)).cd_per_lm, 0);
  EXPECT_EQ(IntensityTowards(sector, Direction(57, 45)).cd_per_lm, 1);
}

TEST(IntensityTowards, DerivativeIsItsCentralDifference) {
  IntensityTable turned = LopsidedTable();
  turned.table_from_luminaire = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  for (const IntensityTable& table : {LopsidedTable(), turned}) {
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d d = Eigen::Vector3d(normal(rng), normal(rng), normal(rng)).normalized();
      const TableIntensity at = IntensityTowards(table, d);
      EXPECT_NEAR(at.d_direction.dot(d), 0, 1e-12);  // along the sphere
      const Eigen::Vector3d side = d.unitOrthogonal();
      for (const Eigen::Vector3d& t : {side, Eigen::Vector3d(d.cross(side))}) {
        constexpr double kStep = 1e-7;  // truncation 1e-14, rounding 1e-9; no cell is that near by chance
        const double up = IntensityTowards(table, (d + kStep * t).normalized()).cd_per_lm;
        const double down = IntensityTowards(table, (d - kStep * t).normalized()).cd_per_lm;
        EXPECT_NEAR(at.d_direction.dot(t), (up - down) / (2 * kStep), 1e-6);
      }
    }
  }
}

TEST(ExpandPlanes, FillsWhatSymmetryImplies) {
  // One intensity a plane, equal to its C in degrees, at gamma 45 and 90.
  struct Case {
    PlaneSymmetry symmetry;
    double first_deg, last_deg;
    std::function<double(double)> measured;  // the plane that stands for C, in degrees
  };
  const auto half = [](double c) { return c <= 180 ? c : 360 - c; };
  const std::vector<Case> cases = {
      {PlaneSymmetry::kNone, 0, 330, [](double c) { return c; }},
      {PlaneSymmetry::kC0C180, 0, 180, half},
      {PlaneSymmetry::kC90C270, 90, 270, [](double c) { return c < 90    ? 180 - c
                                                               : c > 270 ? 540 - c
                                                                         : c; }},
      {PlaneSymmetry::kC90C270, 270, 450, [](double c) { return c <= 90   ? c + 360
                                                                : c < 270 ? 540 - c
                                                                          : c; }},
      {PlaneSymmetry::kQuadrant, 0, 90, [half](double c) { return std::min(half(c), 180 - half(c)); }}};
  for (const Case& one : cases) {
    const std::vector<double> c = Steps(one.first_deg, one.last_deg, 30), g = Steps(45, 90, 45);
    const IntensityTable table =
        ExpandPlanes(c, g, Fill(c, g, [](double x, double) { return x * 180 / kPi; }), one.symmetry);
    EXPECT_EQ(table.c_rad.size(), 13u);
    for (double at = 0; at < 360; at += 30) {
      EXPECT_NEAR(IntensityTowards(table, Direction(at, 60)).cd_per_lm, one.measured(at), 1e-6)
          << one.first_deg << " to " << one.last_deg << " at " << at;
    }
  }
}

TEST(ExpandPlanes, RefusesWhatIsNoTable) {
  const auto expand = [](const std::vector<double>& c, const std::vector<double>& g,
                         const std::vector<double>& i) { ExpandPlanes(c, g, i, PlaneSymmetry::kNone); };
  EXPECT_THROW(expand({}, {0, 1}, {}), std::invalid_argument);
  EXPECT_THROW(expand({0}, {0}, {1}), std::invalid_argument);
  EXPECT_THROW(expand({0}, {0, 1}, {1}), std::invalid_argument);
  EXPECT_THROW(expand({0}, {1, 0}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(expand({1, 0}, {0, 1}, {1, 1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(expand({0}, {0, 4}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(expand({0}, {0, 1}, {1, -1}), std::invalid_argument);
  EXPECT_THROW(expand({0}, {0, 1}, {1, std::nan("")}), std::invalid_argument);
  EXPECT_THROW(Normalized(ExpandPlanes({0}, {0, 1}, {0, 0}, PlaneSymmetry::kRotational)),
               std::invalid_argument);
}

TEST(Normalized, HasOneLumen) {
  EXPECT_NEAR(FluxIntegral(Normalized(LopsidedTable())), 1, 1e-13);  // double rounding
}

TEST(Resampled, IsTheSameLight) {
  IntensityTable turned = LopsidedTable(5, 5);
  turned.table_from_luminaire = Eigen::AngleAxisd(0.7, Eigen::Vector3d(3, 1, 2).normalized()).matrix();
  const IntensityTable plain = Resampled(turned, 5, 1);
  EXPECT_TRUE(plain.table_from_luminaire.isIdentity());
  EXPECT_NEAR(FluxIntegral(plain) / FluxIntegral(turned), 1, 1e-3);  // (5 deg)^2 / 8 of it
  EXPECT_NEAR(IntensityTowards(plain, Direction(33, 61)).cd_per_lm,
              IntensityTowards(turned, Direction(33, 61)).cd_per_lm, 2e-3);
  EXPECT_THROW(Resampled(turned, 7, 1), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
