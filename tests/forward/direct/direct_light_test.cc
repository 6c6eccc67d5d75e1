#include "forward/direct/direct_light.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>

#include "forward/direct/internal/shadowed_light.h"
#include "forward/luminaire/photometry.h"
#include "tests/support/closed_forms.h"
#include "tests/support/forward/adaptive_integral.h"
#include "tests/support/forward/test_lamps.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::kPi;
using support::kUp;
using support::Lamp;
using support::LopsidedTable;
using support::LxPerLm;
using support::NormalAtDepth;

constexpr double kQuadrature = 1e-3;  // the header's promise, of the value
TEST(DirectLight, APointObeysTheInverseSquareCosineLaw) {
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1.5, -2, 0.3), Eigen::Vector3d(0, 0, 1.9)}) {
    const Luminaire isotropic = Lamp(Distribution::kIsotropic, LuminaireShape::kPoint);
    const Luminaire lambertian = Lamp(Distribution::kLambertian, LuminaireShape::kPoint);
    const double expected_isotropic = support::PointLx(1, support::IsotropicCdPerLm, isotropic.position, p);
    const double expected_lambertian =
        support::PointLx(1, support::LambertianCdPerLm, lambertian.position, p);
    EXPECT_NEAR(LxPerLm(isotropic, p) / expected_isotropic, 1, 1e-12);  // double rounding
    EXPECT_NEAR(LxPerLm(lambertian, p) / expected_lambertian, 1, 1e-12);
  }
}

TEST(DirectLight, UnderADiscIsItsClosedForm) {
  for (const double diameter : {0.1, 0.5, 1.0}) {
    for (const double height : {0.3, 0.5, 1.0, 2.0, 5.0}) {
      const Luminaire lamp = Lamp(Distribution::kLambertian, LuminaireShape::kDisc, diameter);
      const double expected = 1 / (kPi * (diameter * diameter / 4 + height * height));
      EXPECT_NEAR(LxPerLm(lamp, {0, 0, 2 - height}) / expected, 1, kQuadrature)
          << "diameter " << diameter << ", height " << height;
    }
  }
}

TEST(DirectLight, UnderTheCornerOfARectangleIsItsClosedForm) {
  for (const double along : {0.1, 0.6, 1.2}) {
    for (const double height : {0.3, 0.5, 1.0, 2.0}) {
      const Luminaire lamp = Lamp(Distribution::kLambertian, LuminaireShape::kRectangle, along, 0.3);
      const double expected =
          support::CornerFactor(along, 0.3, height) / (along * 0.3);  // pi L F, L = 1 / (pi A)
      EXPECT_NEAR(LxPerLm(lamp, {along / 2, 0.15, 2 - height}) / expected, 1, kQuadrature)
          << "along " << along << ", height " << height;
    }
  }
}

TEST(DirectLight, OfARectangleAnywhereIsTheSuperpositionOfItsCorners) {
  const Luminaire lamp = Lamp(Distribution::kLambertian, LuminaireShape::kRectangle, 1.2, 0.6);
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> place(-2, 2), height(0.4, 2);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p(place(rng), place(rng), 2 - height(rng));
    const double expected = support::LambertianRectangleLx(1, lamp.position, 1.2, 0.6, p);
    EXPECT_NEAR(LxPerLm(lamp, p) / expected, 1, kQuadrature) << p.transpose();
  }
}

// The heading turns a rectangle about its aim: what was along x is along y.
TEST(DirectLight, TheHeadingIsTheDirectionOfTheFirstSize) {
  Luminaire lamp = Lamp(Distribution::kLambertian, LuminaireShape::kRectangle, 1.2, 0.6);
  lamp.heading = Eigen::Vector3d(0, 1, 0);
  const Eigen::Vector3d p(0.9, 0.2, 1.2);
  const double expected = support::LambertianRectangleLx(1, lamp.position, 0.6, 1.2, p);
  EXPECT_NEAR(LxPerLm(lamp, p) / expected, 1, kQuadrature);
}

TEST(DirectLight, ThroughASphereRoundTheLampIsOneLumen) {
  for (const Distribution distribution : {Distribution::kIsotropic, Distribution::kLambertian,
                                          Distribution::kCosinePower, Distribution::kMeasured}) {
    for (const LuminaireShape shape :
         {LuminaireShape::kPoint, LuminaireShape::kDisc, LuminaireShape::kRectangle}) {
      Luminaire lamp = Lamp(distribution, shape, 0.8, 0.4);
      lamp.table = LopsidedTable();
      lamp.aim = Eigen::Vector3d(0.5, 0.3, -1).normalized();
      lamp.cosine_exponent = 4;
      constexpr int kBands = 200, kSectors = 100;
      constexpr double kRadius = 1.3;
      double flux_lm = 0;
      for (int i = 0; i < kBands; ++i) {
        const double z = -1 + (i + 0.5) * 2 / kBands, rho = std::sqrt(1 - z * z);
        for (int j = 0; j < kSectors; ++j) {
          const double angle = 2 * kPi * (j + 0.5) / kSectors;
          const Eigen::Vector3d out(rho * std::cos(angle), rho * std::sin(angle), z);
          flux_lm += LxPerLm(lamp, lamp.position + kRadius * out, -out) * 4 * kPi * kRadius * kRadius;
        }
      }
      flux_lm /= kBands * kSectors;
      // Midpoint rule on bands of 0.01: 1e-4 where the lobe has a kink at its horizon; quadrature of the lamp
      // besides.
      EXPECT_NEAR(flux_lm, 1, kQuadrature) << ToString(distribution) << " " << ToString(shape);
    }
  }
}

TEST(DirectLight, IsNoneBehindTheReceiverOrBehindTheLamp) {
  for (const LuminaireShape shape :
       {LuminaireShape::kPoint, LuminaireShape::kDisc, LuminaireShape::kRectangle}) {
    const Luminaire lamp = Lamp(Distribution::kLambertian, shape, 0.6, 0.6);
    EXPECT_EQ(LxPerLm(lamp, {0.4, 0.1, 0}, -kUp), 0);
    EXPECT_EQ(LxPerLm(lamp, {0.4, 0.1, 3}, -kUp), 0);  // faces the lamp, but from above
    EXPECT_GT(LxPerLm(Lamp(Distribution::kIsotropic, shape, 0.6, 0.6), {0.4, 0.1, 3}, -kUp), 0);
    const DirectIlluminance dark = DirectIlluminancePerLumen(lamp, {0.4, 0.1, 3}, -kUp);
    EXPECT_EQ(dark.d_position.norm() + dark.d_size.norm() + dark.d_tilt.norm() + std::abs(dark.d_exponent),
              0);
  }
}

// The defining integral, by adaptive quadrature to `tolerance` of 1 lx per lm.
double IntegralLxPerLm(const Luminaire& lamp, const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                       double tolerance) {
  const LuminaireAxes axes = AxesOf(lamp);
  const bool disc = lamp.shape == LuminaireShape::kDisc;
  const auto integrand = [&](double a, double b) {
    const Eigen::Vector3d d =
        lamp.position + a * lamp.size_m[0] * axes.along + b * lamp.size_m[disc ? 0 : 1] * axes.across - p;
    const double height = normal.dot(d), r = d.norm();
    return height <= 0 ? 0 : IntensityPerLumen(lamp, axes, -d / r).cd_per_lm * height / (r * r * r);
  };
  return disc ? support::MeanOverDisc(integrand, tolerance) : support::MeanOverSquare(integrand, tolerance);
}

TEST(DirectLight, LambertianSurfacesAreTheirDefiningIntegralWholeAndCut) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  const auto random = [&] { return Eigen::Vector3d(normal(rng), normal(rng), normal(rng)); };
  for (const LuminaireShape shape : {LuminaireShape::kDisc, LuminaireShape::kRectangle}) {
    for (const double depth : {3.0, 1.001, 0.9, 0.3, 0.0, -0.5, -0.95}) {
      Luminaire lamp = Lamp(Distribution::kLambertian, shape, 0.9, 0.5);
      lamp.aim = random().normalized();
      lamp.heading = random().normalized();
      lamp.position = -lamp.aim - 0.3 * AxesOf(lamp).along + 0.4 * AxesOf(lamp).across;
      const Eigen::Vector3d n = NormalAtDepth(lamp, random(), depth);
      EXPECT_NEAR(LxPerLm(lamp, {0, 0, 0}, n), IntegralLxPerLm(lamp, {0, 0, 0}, n, 1e-8), 1e-7)
          << ToString(shape) << " " << depth;
    }
  }
}

// Where a closed form would be rounding, a sum takes over; a lamp without extent is a point.
TEST(DirectLight, ValuesAloneAreThoseWithDerivatives) {
  for (const LuminaireShape shape :
       {LuminaireShape::kPoint, LuminaireShape::kDisc, LuminaireShape::kRectangle}) {
    for (const Distribution distribution : {Distribution::kLambertian, Distribution::kCosinePower}) {
      const Luminaire lamp = Lamp(distribution, shape, 1.2, 0.3);
      for (const Eigen::Vector3d& p : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, -2, 0.4)})
        EXPECT_NEAR(DirectLxPerLumen(lamp, p, kUp) / LxPerLm(lamp, p), 1, 1e-12) << ToString(shape);
    }
  }
}

TEST(DirectLight, ATinyLampIsAPoint) {
  for (const LuminaireShape shape : {LuminaireShape::kDisc, LuminaireShape::kRectangle}) {
    const Eigen::Vector3d p(0.7, -0.4, 0.3), n = Eigen::Vector3d(-0.2, 0.1, 1).normalized();
    const Luminaire point = Lamp(Distribution::kLambertian, LuminaireShape::kPoint);
    const DirectIlluminance expected = DirectIlluminancePerLumen(point, p, n);
    for (const double size : {0.0, 1e-9, 1.6e-4, 1.8e-4, 2.0e-4, 2.2e-4, 2.4e-4}) {
      const DirectIlluminance light =
          DirectIlluminancePerLumen(Lamp(Distribution::kLambertian, shape, size, size), p, n);
      // The size counts by its square, 2e-8; both sides of the switch at 1e-8 r^2 of area.
      EXPECT_NEAR(light.lx_per_lm / expected.lx_per_lm, 1, 1e-7) << ToString(shape) << " " << size;
      // Derivatives are differences of angles once more.
      EXPECT_LT((light.d_position - expected.d_position).norm(), 1e-5 * expected.d_position.norm())
          << ToString(shape) << " " << size;
      EXPECT_TRUE(light.d_tilt.allFinite() && light.d_size.allFinite()) << size;
    }
    EXPECT_GT(LxPerLm(Lamp(Distribution::kLambertian, shape, 1, 0), p, n), 0);  // a line
  }
}

// A beam of some 12 degrees to its half value, in steps of 2.5 degrees.
std::shared_ptr<const IntensityTable> BeamTable() {
  std::vector<double> gamma_rad, intensity;
  for (int i = 0; i <= 72; ++i) {
    gamma_rad.push_back(i * kPi / 72);
    intensity.push_back(std::exp(-15 * gamma_rad.back() * gamma_rad.back()) + 0.01);
  }
  return std::make_shared<IntensityTable>(
      Normalized(ExpandPlanes({0}, gamma_rad, intensity, PlaneSymmetry::kRotational)));
}

// What the header promises of sums: from the distance of the longer side on, whole and cut.
void ExpectSumsHold(Luminaire lamp, double whole_error, double cut_error, const std::string& what) {
  lamp.position.setZero();
  for (const double distance : {1.0, 1.6, 3.0, 7.0}) {
    const double beam_lx = IntegralLxPerLm(lamp, {0, 0, -distance}, kUp, 1e-6);
    for (const double degrees : {0.0, 15.0, 50.0, 75.0}) {
      const double angle = degrees * kPi / 180;
      const Eigen::Vector3d p =
          distance * Eigen::Vector3d(std::sin(angle) * 0.8, std::sin(angle) * 0.6, -std::cos(angle));
      const double facing_lx = IntegralLxPerLm(lamp, p, -p / distance, 1e-5 * beam_lx);
      Luminaire from_p = lamp;
      from_p.position = -p;
      for (const double depth : {9.0, 1.01, 0.5, -0.2}) {
        const Eigen::Vector3d n = NormalAtDepth(from_p, Eigen::Vector3d(0.3, -0.7, 0.5), depth);
        const double expected = IntegralLxPerLm(lamp, p, n, 1e-7 * beam_lx);
        const double bound = depth > 1 ? whole_error * std::max(expected, 1e-3 * beam_lx)
                                       : cut_error * std::max(facing_lx, 1e-3 * beam_lx);
        EXPECT_NEAR(LxPerLm(lamp, p, n), expected, bound)
            << what << ", " << ToString(lamp.shape) << ", " << distance << " m, " << degrees << " deg, depth "
            << depth;
        EXPECT_NEAR(DirectLxPerLumen(lamp, p, n), LxPerLm(lamp, p, n), 1e-12 * beam_lx) << what;
      }
    }
  }
}

TEST(DirectLight, SumsHoldWhatTheHeaderPromises) {
  for (const LuminaireShape shape : {LuminaireShape::kDisc, LuminaireShape::kRectangle}) {
    ExpectSumsHold(Lamp(Distribution::kIsotropic, shape, 1, 0.7), 1e-3, 2e-3, "isotropic");
    Luminaire lamp = Lamp(Distribution::kCosinePower, shape, 1, 0.7);
    for (const double exponent : {2.0, 5.0, 12.0, 40.0, 100.0}) {
      lamp.cosine_exponent = exponent;
      ExpectSumsHold(lamp, 1e-3, 2e-3, "cos^" + std::to_string(exponent));
    }
    lamp.distribution = Distribution::kMeasured;
    lamp.table = LopsidedTable();
    ExpectSumsHold(lamp, 2e-3, 2e-3, "lopsided table");
    lamp.table = BeamTable();
    ExpectSumsHold(lamp, 2e-3, 2e-3, "beam");
  }
  ExpectSumsHold(Lamp(Distribution::kCosinePower, LuminaireShape::kRectangle, 1, 0.05), 1e-3, 2e-3, "strip");
}

TEST(DirectLight, NaNInIsNaNOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const RayScene open{Scene{}};
  const std::vector<std::function<void(Luminaire&, Eigen::Vector3d&, Eigen::Vector3d&)>> spoilers = {
      [&](Luminaire& lamp, Eigen::Vector3d&, Eigen::Vector3d&) { lamp.position.x() = nan; },
      [&](Luminaire& lamp, Eigen::Vector3d&, Eigen::Vector3d&) { lamp.aim.y() = nan; },
      [&](Luminaire&, Eigen::Vector3d& p, Eigen::Vector3d&) { p.y() = nan; },
      [&](Luminaire&, Eigen::Vector3d&, Eigen::Vector3d& n) { n.x() = nan; }};
  for (const Distribution distribution : {Distribution::kIsotropic, Distribution::kLambertian,
                                          Distribution::kCosinePower, Distribution::kMeasured}) {
    for (const LuminaireShape shape :
         {LuminaireShape::kPoint, LuminaireShape::kDisc, LuminaireShape::kRectangle}) {
      for (size_t k = 0; k < spoilers.size(); ++k) {
        const std::string which = ToString(distribution) + " " + ToString(shape) + " " + std::to_string(k);
        Luminaire lamp = Lamp(distribution, shape, 0.6, 0.4);
        lamp.table = LopsidedTable();
        Eigen::Vector3d p(0.3, 0.2, 0), n = kUp;
        spoilers[k](lamp, p, n);
        // The light of an isotropic point, and which point it is that is seen, do not depend on its aim.
        const bool matters = k != 1 || shape != LuminaireShape::kPoint;
        if (matters || distribution != Distribution::kIsotropic) {
          EXPECT_TRUE(std::isnan(LxPerLm(lamp, p, n))) << which;
          EXPECT_TRUE(std::isnan(VisibleIlluminancePerLumen(open, lamp, p, n))) << which;
          EXPECT_TRUE(std::isnan(ShadowedIlluminancePerLumen(open, lamp, p, n).lx_per_lm)) << which;
        }
        if (matters) {
          EXPECT_TRUE(std::isnan(VisibleFraction(open, lamp, p, n, 3))) << which;
          EXPECT_TRUE(std::isnan(VisibleShare(open, lamp, p, n))) << which;
        }
      }
    }
  }
}

// C0 along the heading, C90 counter-clockwise from above, on whatever side the luminaire is turned.
TEST(DirectLight, AMeasuredLobeIsTurnedWithItsLamp) {
  Luminaire lamp = Lamp(Distribution::kMeasured, LuminaireShape::kPoint);
  lamp.table = LopsidedTable();
  const auto cd_per_lm = [&](double c, double g) {
    const Eigen::Vector3d in_lamp(std::sin(g) * std::cos(c), std::sin(g) * std::sin(c), -std::cos(g));
    return IntensityTowards(*lamp.table, in_lamp).cd_per_lm;
  };
  lamp.heading = {0, 1, 0};
  // 45 degrees down, towards +y (C0), -x (C90), -y (C180), +x (C270); 2 m below.
  const Eigen::Vector3d places[] = {{0, 2, 0}, {-2, 0, 0}, {0, -2, 0}, {2, 0, 0}};
  for (int i = 0; i < 4; ++i) {
    const double expected = cd_per_lm(i * kPi / 2, kPi / 4) * std::sqrt(0.5) / 8;
    EXPECT_NEAR(LxPerLm(lamp, places[i]) / expected, 1, 1e-12) << i;  // double rounding
  }
  // At a wall, heading still +y: the luminaire's +y = +z x +x is -z of the world, so C90 is down.
  lamp.aim = {1, 0, 0};
  const Eigen::Vector3d wall(-1, 0, 0);
  EXPECT_NEAR(LxPerLm(lamp, {1, 0, 1}, wall) / (cd_per_lm(0.5 * kPi, kPi / 4) * std::sqrt(0.5) / 2), 1,
              1e-12);
  EXPECT_NEAR(LxPerLm(lamp, {1, 0, 3}, wall) / (cd_per_lm(1.5 * kPi, kPi / 4) * std::sqrt(0.5) / 2), 1,
              1e-12);
}

TEST(DirectLight, AMeasuredLambertianIsALambertian) {
  Luminaire measured = Lamp(Distribution::kMeasured, LuminaireShape::kRectangle, 0.6, 0.3);
  std::vector<double> gamma_rad, intensity;
  for (int i = 0; i <= 360; ++i) {
    gamma_rad.push_back(i * kPi / 720);
    intensity.push_back(std::max(0.0, std::cos(gamma_rad.back())));
  }
  measured.table = std::make_shared<IntensityTable>(
      Normalized(ExpandPlanes({0}, gamma_rad, intensity, PlaneSymmetry::kRotational)));
  Luminaire lambertian = measured;
  lambertian.distribution = Distribution::kLambertian;
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, -2, 0.4)})
    // (0.25 deg)^2 / 8, the flux's, and 2.6e-5 of the sum over points.
    EXPECT_NEAR(LxPerLm(measured, p) / LxPerLm(lambertian, p), 1, 4e-5);
}

// A screen whose edge stands over the middle of the lamp, seen from straight below.
class HalfScreened : public testing::Test {
 protected:
  HalfScreened() { support::AddParallelogram(scene_, {0, -2, 1}, {2, 0, 0}, {0, 4, 0}, "screen"); }
  Scene scene_;
  const Eigen::Vector3d below_{0, 0, 0};
  static constexpr int kOrder = 6;  // even: no surface point on the screen's edge
};

TEST_F(HalfScreened, HalfTheLampGivesHalfTheLight) {
  const RayScene rays(scene_), open(Scene{});
  const Luminaire lamp = Lamp(Distribution::kLambertian, LuminaireShape::kRectangle, 0.6, 0.6);
  const double half = VisibleIlluminancePerLumen(rays, lamp, below_, kUp);
  const double whole = VisibleIlluminancePerLumen(open, lamp, below_, kUp);
  EXPECT_NEAR(half / whole, 0.5, 1.0 / 64);  // a cell of the finest grid
  EXPECT_NEAR(whole / support::LambertianRectangleLx(1, lamp.position, 0.6, 0.6, below_), 1, kQuadrature);
  EXPECT_NEAR(VisibleFraction(rays, lamp, below_, kUp, kOrder), 0.5, 1e-12);
  EXPECT_NEAR(VisibleFraction(open, lamp, below_, kUp, kOrder), 1, 1e-12);
}

TEST_F(HalfScreened, BehindTheReceiversPlaneNothingIsVisible) {
  const Luminaire lamp = Lamp(Distribution::kLambertian, LuminaireShape::kRectangle, 0.6, 0.6);
  const RayScene open{Scene{}};
  EXPECT_EQ(VisibleFraction(open, lamp, below_, -kUp, kOrder), 0);
  EXPECT_EQ(VisibleIlluminancePerLumen(open, lamp, below_, -kUp), 0);
  // A receiver whose plane cuts the lamp in the middle sees all that is in front, which is all that lights
  // it.
  EXPECT_NEAR(VisibleFraction(open, lamp, below_, Eigen::Vector3d(1, 0, 0), kOrder), 1, 1e-12);
}

}  // namespace
}  // namespace luxfit
