#include "forward/luminaire/luminaire.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "forward/direct/direct_light.h"
#include "tests/support/closed_forms.h"

namespace luxfit {
namespace {

using support::kPi;

std::vector<Luminaire> OneOfEachDistribution() {
  std::vector<Luminaire> list(6);
  list[0].distribution = Distribution::kIsotropic;
  list[1].distribution = Distribution::kLambertian;
  const double exponents[] = {0.4, 1, 3, 20};
  for (size_t i = 0; i < 4; ++i) {
    list[2 + i].distribution = Distribution::kCosinePower;
    list[2 + i].cosine_exponent = exponents[i];
  }
  return list;
}

TEST(IntensityPerLumen, IntegratesToOneLumen) {
  for (const Luminaire& luminaire : OneOfEachDistribution()) {
    // Phi = 2 pi int I d(cos gamma) over the sphere, midpoint rule.
    constexpr int kCells = 20000;
    double flux_lm = 0;
    for (int i = 0; i < kCells; ++i) {
      const double cosine = -1 + (i + 0.5) * 2 / kCells;
      flux_lm += 2 * kPi * IntensityPerLumen(luminaire, cosine).cd_per_lm * 2 / kCells;
    }
    // The rule's error is below cell^(1 + m) = 1e-4^1.4 at the horizon of m = 0.4, the roughest of them.
    EXPECT_NEAR(flux_lm, 1, 1e-5) << ToString(luminaire.distribution) << " " << luminaire.cosine_exponent;
  }
}

TEST(IntensityPerLumen, DerivativesAreThoseOfTheIntensity) {
  constexpr double kStep = 1e-6;  // truncation 1e-12 of the value, rounding 1e-10
  for (Luminaire luminaire : OneOfEachDistribution()) {
    for (const double cosine : {0.05, 0.3, 0.7, 0.99}) {
      const Intensity intensity = IntensityPerLumen(luminaire, cosine);
      const double up = IntensityPerLumen(luminaire, cosine + kStep).cd_per_lm;
      const double down = IntensityPerLumen(luminaire, cosine - kStep).cd_per_lm;
      EXPECT_NEAR(intensity.d_cosine, (up - down) / (2 * kStep), 1e-7);
      Luminaire wider = luminaire, narrower = luminaire;
      wider.cosine_exponent -= kStep;
      narrower.cosine_exponent += kStep;
      const double difference =
          IntensityPerLumen(narrower, cosine).cd_per_lm - IntensityPerLumen(wider, cosine).cd_per_lm;
      EXPECT_NEAR(intensity.d_exponent, difference / (2 * kStep), 1e-7);
    }
  }
}

TEST(IntensityPerLumen, LobesEndAtTheHorizon) {
  for (const Luminaire& luminaire : OneOfEachDistribution()) {
    const double expected = luminaire.distribution == Distribution::kIsotropic ? 1 / (4 * kPi) : 0;
    EXPECT_DOUBLE_EQ(IntensityPerLumen(luminaire, 0).cd_per_lm, expected);
    EXPECT_DOUBLE_EQ(IntensityPerLumen(luminaire, -0.5).cd_per_lm, expected);
  }
}

TEST(IntensityPerLumen, ALambertianIsACosinePowerOfOne) {
  Luminaire lambertian, cosine_power;
  cosine_power.distribution = Distribution::kCosinePower;
  cosine_power.cosine_exponent = 1;
  for (const double cosine : {0.1, 0.5, 1.0}) {
    EXPECT_NEAR(IntensityPerLumen(lambertian, cosine).cd_per_lm,
                IntensityPerLumen(cosine_power, cosine).cd_per_lm,
                1e-15);  // double rounding
  }
}

TEST(Luminaire, AHundredLumensLambertianGive31LuxBelow) {
  Luminaire luminaire;
  luminaire.flux_lm = 100;
  const DirectIlluminance direct = DirectIlluminancePerLumen(luminaire, {0, 0, -1}, {0, 0, 1});
  EXPECT_NEAR(luminaire.flux_lm * direct.lx_per_lm, 31.83, 0.005);  // as printed; exactly 100 / pi
}

// Area means over the unit square (side 1) and the unit disc (diameter 1).
TEST(SampleSurface, HasTheMomentsOfItsShape) {
  struct Expected {
    LuminaireShape shape;
    double second;  // mean a^2 = mean b^2
  };
  for (const Expected& expected :
       {Expected{LuminaireShape::kRectangle, 1. / 12}, Expected{LuminaireShape::kDisc, 1. / 16},
        Expected{LuminaireShape::kPoint, 0}, Expected{LuminaireShape::kSphere, 0}}) {
    for (int order = 2; order <= 12; ++order) {  // two points a side are exact to the third power
      double weight = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
      for (const SurfaceSample& s : SampleSurface(expected.shape, order)) {
        weight += s.weight, a += s.weight * s.a, b += s.weight * s.b;
        aa += s.weight * s.a * s.a, bb += s.weight * s.b * s.b, ab += s.weight * s.a * s.b;
      }
      const std::string which = ToString(expected.shape) + " of order " + std::to_string(order);
      EXPECT_NEAR(weight, 1, 1e-12) << which;  // double rounding, here and below
      EXPECT_NEAR(a, 0, 1e-12) << which;
      EXPECT_NEAR(b, 0, 1e-12) << which;
      EXPECT_NEAR(aa, expected.second, 1e-12) << which;
      EXPECT_NEAR(bb, expected.second, 1e-12) << which;
      EXPECT_NEAR(ab, 0, 1e-12) << which;
    }
  }
}

TEST(SampleSurface, StaysOnItsShape) {
  for (const SurfaceSample& s : SampleSurface(LuminaireShape::kRectangle, 12)) {
    EXPECT_LT(std::max(std::abs(s.a), std::abs(s.b)), 0.5);
  }
  for (const SurfaceSample& s : SampleSurface(LuminaireShape::kDisc, 12))
    EXPECT_LT(std::hypot(s.a, s.b), 0.5);
  EXPECT_THROW(SampleSurface(LuminaireShape::kDisc, 0), std::invalid_argument);
}

TEST(AxesOf, ArePerpendicularToTheAim) {
  Luminaire luminaire;
  luminaire.aim = Eigen::Vector3d(0.3, -0.2, -1).normalized();
  for (const Eigen::Vector3d& heading : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 2, 1), luminaire.aim}) {
    luminaire.heading = heading.normalized();
    const LuminaireAxes axes = AxesOf(luminaire);
    Eigen::Matrix3d frame;
    frame << axes.along, axes.across, luminaire.aim;
    EXPECT_NEAR((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 0,
                1e-12);  // double rounding
    EXPECT_NEAR((axes.across - luminaire.aim.cross(axes.along)).norm(), 0, 1e-12);
  }
  luminaire.heading = Eigen::Vector3d(1, 0, 0);
  EXPECT_GT(AxesOf(luminaire).along.dot(luminaire.heading), 0.9);  // a heading is kept as far as it can be
}

}  // namespace
}  // namespace luxfit
