// Derivatives of direct light, also where the receiver's plane cuts the luminaire, against central
// differences.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <random>
#include <tuple>

#include "forward/direct/direct_light.h"
#include "tests/support/forward/test_lamps.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::kUp;
using support::Lamp;
using support::LopsidedTable;
using support::LxPerLm;
using support::NormalAtDepth;

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
    // Small, so that neither the quadrature's order switches in between nor one of its points crosses an
    // angle of the table: truncation 1e-14, rounding 1e-9 of E.
    constexpr double kStep = 1e-7;
    Luminaire up = lamp_, down = lamp_;
    change(up, kStep);
    change(down, -kStep);
    const double numeric = (LxPerLm(up, p_, normal_) - LxPerLm(down, p_, normal_)) / (2 * kStep);
    EXPECT_NEAR(analytic, numeric, 1e-7 * (1 + std::abs(numeric))) << what;
  }

  void ExpectAllDerivatives() {
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
    ExpectAllDerivatives();
  }
  EXPECT_GT(lit, 25);  // else the test looked at darkness
}

INSTANTIATE_TEST_SUITE_P(AllLamps, DirectLightDerivatives,
                         testing::Combine(testing::Values(Distribution::kIsotropic, Distribution::kLambertian,
                                                          Distribution::kCosinePower,
                                                          Distribution::kMeasured),
                                          testing::Values(LuminaireShape::kPoint, LuminaireShape::kDisc,
                                                          LuminaireShape::kRectangle)));

class CutByTheReceiversPlane : public DirectLightDerivatives {
 protected:
  void DrawCut(double depth) {
    Draw();
    // In front of the lamp, whose light is that of a closed form.
    lamp_.position = -(1.2 * lamp_.aim + 0.4 * AxesOf(lamp_).along - 0.2 * AxesOf(lamp_).across);
    p_ = Eigen::Vector3d::Zero();
    std::normal_distribution<double> normal;
    normal_ = NormalAtDepth(lamp_, {normal(rng_), normal(rng_), normal(rng_)}, depth);
    direct_ = DirectIlluminancePerLumen(lamp_, p_, normal_);
  }
};

TEST_P(CutByTheReceiversPlane, DerivativesAreCentralDifferences) {
  for (const double depth : {1.01, 0.99, 0.7, 0.1, 0.0, -0.3, -0.9, -0.99}) {
    for (int i = 0; i < 10; ++i) {
      DrawCut(depth);
      EXPECT_GT(direct_.lx_per_lm, 0) << depth;
      ExpectAllDerivatives();
    }
  }
}

TEST_P(CutByTheReceiversPlane, NothingJumpsWhereTheCutBegins) {
  for (int i = 0; i < 20; ++i) {
    DrawCut(1);
    const Luminaire lamp = lamp_;
    const Eigen::Vector3d away = normal_;
    const DirectIlluminance whole = DirectIlluminancePerLumen(lamp, p_, NormalAtDepth(lamp, away, 1 + 1e-9));
    const DirectIlluminance cut = DirectIlluminancePerLumen(lamp, p_, NormalAtDepth(lamp, away, 1 - 1e-9));
    // A whole rectangle is summed over a few points: to 3e-5 of what a receiver that faces it gets, 3e-4 in derivatives.
    const bool is_summed = lamp.shape == LuminaireShape::kRectangle;
    const double facing_lx = LxPerLm(lamp, p_, (lamp.position - p_).normalized());
    const double jump_lx = is_summed ? 3e-5 * facing_lx : 1e-8 * whole.lx_per_lm;
    const double jump_of_derivative = is_summed ? 3e-4 * facing_lx : 1e-7 * whole.d_position.norm();
    EXPECT_NEAR(cut.lx_per_lm, whole.lx_per_lm, jump_lx);
    EXPECT_LT((cut.d_position - whole.d_position).norm(), jump_of_derivative);
    EXPECT_LT((cut.d_tilt - whole.d_tilt).norm(), jump_of_derivative);
    EXPECT_LT((cut.d_size - whole.d_size).norm(), jump_of_derivative);
  }
}

INSTANTIATE_TEST_SUITE_P(ClosedForms, CutByTheReceiversPlane,
                         testing::Combine(testing::Values(Distribution::kLambertian),
                                          testing::Values(LuminaireShape::kDisc,
                                                          LuminaireShape::kRectangle)));

}  // namespace
}  // namespace luxfit
