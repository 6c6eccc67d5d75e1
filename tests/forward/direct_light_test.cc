#include "forward/direct_light.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <random>

#include "forward/photometry.h"
#include "forward/shadowed_light.h"
#include "tests/support/closed_forms.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::kPi;

constexpr double kQuadrature = 1e-3;  // the header's promise, of the value
const Eigen::Vector3d kUp(0, 0, 1);

Luminaire Lamp(Distribution distribution, LuminaireShape shape, double size_along = 0,
               double size_across = 0) {
  Luminaire lamp;
  lamp.position = Eigen::Vector3d(0, 0, 2);
  lamp.distribution = distribution;
  lamp.shape = shape;
  lamp.size_m = {size_along, size_across};
  return lamp;
}

// Different in every direction; steps of 30 degrees, so that a test's small step rarely meets a kink.
std::shared_ptr<const IntensityTable> LopsidedTable() {
  std::vector<double> c_rad, gamma_rad, intensity;
  for (int i = 0; i < 12; ++i) c_rad.push_back(i * kPi / 6);
  for (int i = 0; i <= 6; ++i) gamma_rad.push_back(i * kPi / 6);
  for (const double c : c_rad) {
    for (const double g : gamma_rad)
      intensity.push_back(2 + std::sin(g) * (std::cos(c) + 0.5 * std::sin(c)) + 0.8 * std::cos(g));
  }
  return std::make_shared<IntensityTable>(
      Normalized(ExpandPlanes(c_rad, gamma_rad, intensity, PlaneSymmetry::kNone)));
}

double LxPerLm(const Luminaire& lamp, const Eigen::Vector3d& p, const Eigen::Vector3d& normal = kUp) {
  return DirectIlluminancePerLumen(lamp, p, normal).lx_per_lm;
}

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

class DirectLightDerivatives : public testing::TestWithParam<std::tuple<Distribution, LuminaireShape>> {
 protected:
  // A lamp above and a receiver below, both turned at random, so that they mostly see each other.
  void Draw() {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> unit(0, 1);
    const auto vector = [&] { return Eigen::Vector3d(normal(rng_), normal(rng_), normal(rng_)); };
    lamp_ = Lamp(std::get<0>(GetParam()), std::get<1>(GetParam()), 0.1 + 0.8 * unit(rng_),
                 0.1 + 0.8 * unit(rng_));
    lamp_.position += 0.5 * vector();
    lamp_.aim = (lamp_.aim + 0.3 * vector()).normalized();
    lamp_.heading = vector().normalized();
    lamp_.cosine_exponent = 1.5 + 5 * unit(rng_);
    lamp_.table = table_;
    p_ = 0.5 * vector();
    normal_ = (kUp + 0.3 * vector()).normalized();
    direct_ = DirectIlluminancePerLumen(lamp_, p_, normal_);
  }

  // Central difference of the illuminance while `change(lamp, step)` moves the lamp.
  template <typename Change>
  void ExpectDerivative(double analytic, const Change& change, const char* what) {
    // Small, so that the quadrature's order does not switch in between: truncation 1e-12, rounding 1e-10 of
    // E.
    constexpr double kStep = 1e-6;
    Luminaire up = lamp_, down = lamp_;
    change(up, kStep);
    change(down, -kStep);
    const double numeric = (LxPerLm(up, p_, normal_) - LxPerLm(down, p_, normal_)) / (2 * kStep);
    EXPECT_NEAR(analytic, numeric, 1e-7 * (1 + std::abs(numeric))) << what;
  }

  std::mt19937_64 rng_ = support::TestRng();
  std::shared_ptr<const IntensityTable> table_ = LopsidedTable();
  Luminaire lamp_;
  Eigen::Vector3d p_, normal_;
  DirectIlluminance direct_;
};

TEST_P(DirectLightDerivatives, AreCentralDifferences) {
  int lit = 0;
  for (int i = 0; i < 50; ++i) {
    Draw();
    lit += direct_.lx_per_lm > 1e-3;
    for (int axis = 0; axis < 3; ++axis) {
      const auto move = [&](Luminaire& lamp, double step) { lamp.position[axis] += step; };
      ExpectDerivative(direct_.d_position[axis], move, "position");
    }
    const LuminaireAxes axes = AxesOf(lamp_);
    for (int axis = 0; axis < 2; ++axis) {
      const auto tilt = [&](Luminaire& lamp, double step) {
        lamp.aim = (lamp.aim + step * (axis == 0 ? axes.along : axes.across)).normalized();
        lamp.heading = axes.along;
      };
      ExpectDerivative(direct_.d_tilt[axis], tilt, "tilt");
      const auto grow = [&](Luminaire& lamp, double step) { lamp.size_m[axis] += step; };
      ExpectDerivative(direct_.d_size[axis], grow, "size");
    }
    const auto turn = [&](Luminaire& lamp, double step) {
      lamp.heading = (axes.along + step * axes.across).normalized();
    };
    ExpectDerivative(direct_.d_heading, turn, "heading");
    const auto narrow = [&](Luminaire& lamp, double step) { lamp.cosine_exponent += step; };
    ExpectDerivative(direct_.d_exponent, narrow, "exponent");
  }
  EXPECT_GT(lit, 25);  // else the test looked at darkness
}

INSTANTIATE_TEST_SUITE_P(AllLamps, DirectLightDerivatives,
                         testing::Combine(testing::Values(Distribution::kIsotropic, Distribution::kLambertian,
                                                          Distribution::kCosinePower,
                                                          Distribution::kMeasured),
                                          testing::Values(LuminaireShape::kPoint, LuminaireShape::kDisc,
                                                          LuminaireShape::kRectangle)));

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
    EXPECT_NEAR(LxPerLm(measured, p) / LxPerLm(lambertian, p), 1, 1e-5);  // (0.25 deg)^2 / 8 and the flux's
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
