#include "inverse/albedo/reflectance_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

ReflectanceCurve TypicalCurve(CurveKind kind) {
  ReflectanceCurve curve = StartCurve(kind);
  if (kind == CurveKind::kExponent) curve.parameters << std::log(0.85);
  if (kind == CurveKind::kOrenNayar) curve.parameters << 0.06;
  if (kind == CurveKind::kGloss) curve.parameters << std::log(0.9), 0.2, std::log(12.0);
  return curve;
}

// Central differences against the derivatives, at angles on both sides of Oren and Nayar's branches.
TEST(ReflectanceCurve, DerivativesMatchFiniteDifferences) {
  constexpr double kStep = 1e-6;
  for (const CurveKind kind : AllCurveKinds()) {
    for (const CurveAngles& at : {CurveAngles{0.8, 0.6, 0.7, 0.9}, CurveAngles{0.3, 0.9, 0.5, 0.85},
                                  CurveAngles{0.5, 0.9, 0.2, 0.7}}) {
      const ReflectanceCurve curve = TypicalCurve(kind);
      const CurveValue value = Evaluate(curve, at);
      const auto slope = [&](double CurveAngles::*angle) {
        CurveAngles above = at, below = at;
        above.*angle += kStep;
        below.*angle -= kStep;
        return (Evaluate(curve, above).f - Evaluate(curve, below).f) / (2 * kStep);
      };
      EXPECT_NEAR(value.d_mu, slope(&CurveAngles::mu), 1e-7) << ToString(kind);
      EXPECT_NEAR(value.d_nu, slope(&CurveAngles::nu), 1e-7) << ToString(kind);
      EXPECT_NEAR(value.d_c, slope(&CurveAngles::c), 1e-7) << ToString(kind);
      EXPECT_NEAR(value.d_eta, slope(&CurveAngles::eta), 1e-7) << ToString(kind);
      for (Eigen::Index p = 0; p < curve.parameters.size(); ++p) {
        ReflectanceCurve above = curve, below = curve;
        above.parameters[p] += kStep;
        below.parameters[p] -= kStep;
        EXPECT_NEAR(value.d_parameters[p], (Evaluate(above, at).f - Evaluate(below, at).f) / (2 * kStep),
                    1e-7)
            << ToString(kind) << " parameter " << p;
      }
    }
  }
}

TEST(ReflectanceCurve, NothingComesFromBehind) {
  for (const CurveKind kind : AllCurveKinds())
    EXPECT_EQ(Evaluate(TypicalCurve(kind), {-0.1, 0.9, 0.5, 0.8}).f, 0) << ToString(kind);
}

// Their eq. 30 at theta_r = theta_i = 60 degrees, same azimuth, sigma = 0.5: A = 0.78448, B = 0.33088,
// f = 0.5 (A + B sin 60 tan 60).
TEST(ReflectanceCurve, OrenNayarAsPublished) {
  ReflectanceCurve curve = StartCurve(CurveKind::kOrenNayar);
  curve.parameters << 0.25;
  const double a = 1 - 0.5 * 0.25 / 0.58, b = 0.45 * 0.25 / 0.34;
  EXPECT_NEAR(Evaluate(curve, {0.5, 0.5, 1, 0.5}).f, 0.5 * (a + b * 1.5), 1e-12);
}

TEST(ReflectanceCurve, EveryKindStartsNearLambert) {
  for (const CurveKind kind : AllCurveKinds()) {
    const ReflectanceCurve curve = StartCurve(kind);
    EXPECT_EQ(curve.parameters.size(), ParameterCount(kind));
    EXPECT_FALSE(IsAtBound(curve)) << ToString(kind);
    EXPECT_NEAR(Evaluate(curve, {0.7, 0.8, 0.6, 0.5}).f, 0.7, 0.05) << ToString(kind);
  }
}

TEST(ReflectanceCurve, BoundsHold) {
  ReflectanceCurve curve = StartCurve(CurveKind::kOrenNayar);
  curve.parameters << -0.3;
  EXPECT_EQ(WithinBounds(curve).parameters[0], 0);
  EXPECT_TRUE(IsAtBound(curve));
  curve.parameters.resize(2);
  EXPECT_THROW(Evaluate(curve, {}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
