#include "inverse/choose/internal/detail/needless_parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace luxfit {
namespace {

constexpr double kDegree = M_PI / 180;

// A fit by hand of two rectangles that look down, with sigmas of 1 cm and 1 % where a test sets no other.
class NeedlessParameters : public testing::Test {
 protected:
  NeedlessParameters() {
    fit_.status = FitStatus::kConverged;
    fit_.state.luminaires.resize(2);
    fit_.state.free.resize(2);
    for (size_t k = 0; k < 2; ++k) {
      Luminaire& luminaire = fit_.state.luminaires[k];
      luminaire.id = k == 0 ? "A" : "B";
      luminaire.distribution = Distribution::kCosinePower;
      luminaire.cosine_exponent = 3;
      luminaire.shape = LuminaireShape::kRectangle;
      luminaire.size_m = {0.6, 0.3};
      fit_.state.free[k].exponent = fit_.state.free[k].tilt = fit_.state.free[k].heading = true;
      luminaire.aim = Eigen::Vector3d(0.4, 0.3, -1).normalized();
      luminaire.heading = Eigen::Vector3d(1, 1, 0).normalized();
    }
    fit_.state.camera_scale_free = false;
    // Nothing but what a test simplifies is near its simplest value.
    fit_.parameters = FreeParameters(MakeRoom(Scene{}), fit_.state);
    fit_.covariance = 1e-4 * Eigen::MatrixXd::Identity(Count(), Count());
  }

  Eigen::Index Count() const { return static_cast<Eigen::Index>(fit_.parameters.size()); }

  Eigen::Index IndexOf(int luminaire, LuminaireQuantity quantity) const {
    for (size_t i = 0; i < fit_.parameters.size(); ++i)
      if (fit_.parameters[i].Is(ParameterKind::kLuminaire, luminaire, quantity))
        return static_cast<Eigen::Index>(i);
    ADD_FAILURE() << "no such parameter";
    return 0;
  }

  void SetExponent(int luminaire, double exponent, double sigma) {
    fit_.state.luminaires[static_cast<size_t>(luminaire)].cosine_exponent = exponent;
    const Eigen::Index i = IndexOf(luminaire, LuminaireQuantity::kExponent);
    fit_.covariance(i, i) = std::pow(sigma / exponent, 2);  // of its logarithm
  }

  // From straight down, along and across; the errors of both have the same sigma and a correlation.
  void SetTilt(int luminaire, const Eigen::Vector2d& tilt_rad, double sigma_rad, double correlation = 0) {
    Luminaire& tilted = fit_.state.luminaires[static_cast<size_t>(luminaire)];
    tilted.aim = Eigen::Vector3d(0, 0, -1);
    tilted.heading = Eigen::Vector3d(1, 0, 0);
    const LuminaireAxes axes = AxesOf(tilted);
    tilted.aim = (tilted.aim + tilt_rad[0] * axes.along + tilt_rad[1] * axes.across).normalized();
    const Eigen::Index along = IndexOf(luminaire, LuminaireQuantity::kTiltAlong),
                       across = IndexOf(luminaire, LuminaireQuantity::kTiltAcross);
    const double variance = sigma_rad * sigma_rad;
    fit_.covariance(along, along) = fit_.covariance(across, across) = variance;
    fit_.covariance(along, across) = fit_.covariance(across, along) = correlation * variance;
    fit_.parameters = Recentred(fit_.parameters, fit_.state);
  }

  void SetHeading(int luminaire, double turn_rad, double sigma_rad) {
    Luminaire& turned = fit_.state.luminaires[static_cast<size_t>(luminaire)];
    turned.aim = Eigen::Vector3d(0, 0, -1);
    turned.heading = Eigen::Vector3d(std::cos(turn_rad), std::sin(turn_rad), 0);
    const Eigen::Index i = IndexOf(luminaire, LuminaireQuantity::kHeading);
    fit_.covariance(i, i) = sigma_rad * sigma_rad;
    fit_.parameters = Recentred(fit_.parameters, fit_.state);
  }

  // Opens one choice of both luminaires. They are held straight down, along x.
  SimplifiedState Simplified(bool distribution, bool aim, bool heading = false) const {
    const OpenChoice open{distribution, false, aim, heading};
    return WithoutNeedlessParameters(fit_, {open, open}, std::vector<HeldDirections>(2));
  }

  void ExpectUntouched(const SimplifiedState& simplified, size_t k) const {
    const Luminaire &found = simplified.state.luminaires[k], &fitted = fit_.state.luminaires[k];
    EXPECT_EQ(found.distribution, fitted.distribution);
    EXPECT_EQ(found.cosine_exponent, fitted.cosine_exponent);
    EXPECT_EQ(found.aim, fitted.aim);
    EXPECT_EQ(found.heading, fitted.heading);
    EXPECT_TRUE(simplified.state.free[k].exponent);
    EXPECT_TRUE(simplified.state.free[k].tilt);
    EXPECT_TRUE(simplified.state.free[k].heading);
  }

  LuminaireFit fit_;
};

TEST_F(NeedlessParameters, AnExponentNearOneIsLambertian) {
  SetExponent(1, 1.009, 0.02);
  const SimplifiedState simplified = Simplified(true, false);
  ASSERT_EQ(simplified.needless.size(), 1u);
  EXPECT_EQ(simplified.needless[0].luminaire, 1);
  EXPECT_EQ(simplified.needless[0].kind, NeedlessKind::kExponent);
  EXPECT_DOUBLE_EQ(simplified.needless[0].fitted, 1.009);
  EXPECT_NEAR(simplified.needless[0].sigma, 0.02, 1e-12);
  const Luminaire& b = simplified.state.luminaires[1];
  EXPECT_EQ(b.distribution, Distribution::kLambertian);
  EXPECT_EQ(b.cosine_exponent, 1);
  EXPECT_FALSE(simplified.state.free[1].exponent);
  EXPECT_TRUE(simplified.state.free[1].tilt);
  EXPECT_EQ(b.aim, fit_.state.luminaires[1].aim);
  ExpectUntouched(simplified, 0);
}

TEST_F(NeedlessParameters, AnExponentThatTheFitTellsFromOneStays) {
  SetExponent(0, 1.2, 0.02);
  const SimplifiedState simplified = Simplified(true, false);
  EXPECT_TRUE(simplified.needless.empty());
  ExpectUntouched(simplified, 0);
}

// chi2_95 of one parameter is 1.96^2: a little less of the logarithm's sigma goes, a little more stays.
TEST_F(NeedlessParameters, TheBoundIsThatOf95Percent) {
  SetExponent(0, std::exp(1.9 * 0.02), 0.02 * std::exp(1.9 * 0.02));
  EXPECT_EQ(Simplified(true, false).needless.size(), 1u);
  SetExponent(0, std::exp(2.0 * 0.02), 0.02 * std::exp(2.0 * 0.02));
  EXPECT_TRUE(Simplified(true, false).needless.empty());
}

TEST_F(NeedlessParameters, ATiltWithinItsSigmaGoesBackToTheHeldAim) {
  const Eigen::Vector2d tilt = Eigen::Vector2d(0.07, 0.07) * kDegree;  // 0.1 degrees in all
  SetTilt(0, tilt, 0.08 * kDegree);
  const SimplifiedState simplified = Simplified(false, true);
  ASSERT_EQ(simplified.needless.size(), 1u);
  EXPECT_EQ(simplified.needless[0].luminaire, 0);
  EXPECT_EQ(simplified.needless[0].kind, NeedlessKind::kTilt);
  EXPECT_NEAR(simplified.needless[0].fitted, tilt.norm(), 1e-7);  // arc and tangent, arccosine near 1
  EXPECT_NEAR(simplified.needless[0].sigma, 0.08 * kDegree, 1e-12);
  EXPECT_EQ(simplified.state.luminaires[0].aim, Eigen::Vector3d(0, 0, -1));
  EXPECT_FALSE(simplified.state.free[0].tilt);
  EXPECT_TRUE(simplified.state.free[0].exponent);
  ExpectUntouched(simplified, 1);
}

TEST_F(NeedlessParameters, ATiltOfTwoDegreesStays) {
  SetTilt(0, Eigen::Vector2d(2, 0) * kDegree, 0.08 * kDegree);
  const SimplifiedState simplified = Simplified(false, true);
  EXPECT_TRUE(simplified.needless.empty());
  ExpectUntouched(simplified, 0);
}

// (1, -1) sigma has 2 / (1 - r) = 25 sigma^2 by the errors' correlation r = 0.92. Without it, 2 of 5.99.
TEST_F(NeedlessParameters, CorrelationsTellATiltApart) {
  const double sigma = 0.08 * kDegree;
  SetTilt(0, Eigen::Vector2d(sigma, -sigma), sigma, 0.92);
  const SimplifiedState simplified = Simplified(false, true);
  EXPECT_TRUE(simplified.needless.empty());
  ExpectUntouched(simplified, 0);
  SetTilt(0, Eigen::Vector2d(sigma, -sigma), sigma, 0);
  EXPECT_EQ(Simplified(false, true).needless.size(), 1u);
}

TEST_F(NeedlessParameters, ATurnNearAQuarterIsAQuarter) {
  SetHeading(0, (90 + 0.5) * kDegree, 1 * kDegree);
  const SimplifiedState simplified = Simplified(false, false, true);
  ASSERT_EQ(simplified.needless.size(), 1u);
  EXPECT_EQ(simplified.needless[0].luminaire, 0);
  EXPECT_EQ(simplified.needless[0].kind, NeedlessKind::kHeading);
  EXPECT_NEAR(simplified.needless[0].fitted, 0.5 * kDegree, 1e-12);
  // A rectangle does not tell a quarter turn to one side from that to the other.
  EXPECT_NEAR(std::abs(simplified.state.luminaires[0].heading.y()), 1, 1e-12);
  EXPECT_FALSE(simplified.state.free[0].heading);
  ExpectUntouched(simplified, 1);
  SetHeading(0, 30 * kDegree, 1 * kDegree);
  EXPECT_TRUE(Simplified(false, false, true).needless.empty());
}

TEST_F(NeedlessParameters, ASizeThatTheFitDoesNotTellFromNothingIsAPoint) {
  fit_.state.free[0].size = fit_.state.free[1].size = true;
  fit_.parameters = FreeParameters(MakeRoom(Scene{}), fit_.state);
  fit_.covariance = 1e-4 * Eigen::MatrixXd::Identity(Count(), Count());
  const Eigen::Index along = IndexOf(0, LuminaireQuantity::kSizeAlong),
                     across = IndexOf(0, LuminaireQuantity::kSizeAcross);
  fit_.covariance(along, along) = fit_.covariance(across, across) = 0.16;
  std::vector<OpenChoice> open(2);
  for (OpenChoice& o : open) o.distribution = o.aim = o.heading = false;
  const SimplifiedState simplified = WithoutNeedlessParameters(fit_, open, std::vector<HeldDirections>(2));
  ASSERT_EQ(simplified.needless.size(), 1u);
  EXPECT_EQ(simplified.needless[0].kind, NeedlessKind::kSize);
  EXPECT_DOUBLE_EQ(simplified.needless[0].fitted, 0.6);
  EXPECT_NEAR(simplified.needless[0].sigma, 0.4, 1e-12);
  EXPECT_EQ(simplified.state.luminaires[0].shape, LuminaireShape::kPoint);
  EXPECT_FALSE(simplified.state.free[0].size);
  EXPECT_EQ(simplified.state.luminaires[1].shape, LuminaireShape::kRectangle);
  EXPECT_TRUE(simplified.state.free[1].size);
  // A strip has a length, if no width.
  fit_.covariance(along, along) = 0.01;
  EXPECT_TRUE(WithoutNeedlessParameters(fit_, open, std::vector<HeldDirections>(2)).needless.empty());
}

// An exponent of 3 is 1.1 sigma of its logarithm from 1, and sides of 0.6 m and 0.3 m are 1.2 sigma from nothing. Where
// a smaller opening asks for a larger exponent, both cannot be at their simplest values at once.
TEST_F(NeedlessParameters, QuantitiesThatAreNotNeedlessTogetherAreSimplifiedOneAtATime) {
  fit_.state.free[0].size = true;
  fit_.parameters = FreeParameters(MakeRoom(Scene{}), fit_.state);
  fit_.covariance = 1e-4 * Eigen::MatrixXd::Identity(Count(), Count());
  SetExponent(0, 3, 3);
  const Eigen::Index exponent = IndexOf(0, LuminaireQuantity::kExponent),
                     along = IndexOf(0, LuminaireQuantity::kSizeAlong),
                     across = IndexOf(0, LuminaireQuantity::kSizeAcross);
  fit_.covariance(along, along) = fit_.covariance(across, across) = 0.25;
  std::vector<OpenChoice> open(2);
  for (OpenChoice& o : open) o.aim = o.heading = false;
  open[1].distribution = open[1].shape = false;
  const auto needless = [&] {
    return WithoutNeedlessParameters(fit_, open, std::vector<HeldDirections>(2)).needless;
  };
  EXPECT_EQ(needless().size(), 2u);
  const std::vector<HeldDirections> held(2);
  const auto with_other_points = [&] {
    return WithOtherPoints(fit_, open, held, WithoutNeedlessParameters(fit_, open, held));
  };
  EXPECT_FALSE(with_other_points().has_value());
  fit_.covariance(exponent, along) = fit_.covariance(along, exponent) = -0.95 * 0.5;
  ASSERT_EQ(needless().size(), 1u);
  EXPECT_EQ(needless()[0].kind, NeedlessKind::kExponent);
  // Or the size, and then the exponent stays.
  const std::optional<SimplifiedState> points = with_other_points();
  ASSERT_TRUE(points.has_value());
  ASSERT_EQ(points->needless.size(), 1u);
  EXPECT_EQ(points->needless[0].kind, NeedlessKind::kSize);
  EXPECT_EQ(points->state.luminaires[0].shape, LuminaireShape::kPoint);
  EXPECT_TRUE(points->state.free[0].exponent);
}

TEST_F(NeedlessParameters, WhatIsNotOpenIsNotTouched) {
  SetTilt(0, Eigen::Vector2d(0.07, 0.07) * kDegree, 0.08 * kDegree);
  SetExponent(0, 1.009, 0.02);
  const SimplifiedState simplified = Simplified(false, false);
  EXPECT_TRUE(simplified.needless.empty());
  ExpectUntouched(simplified, 0);
  ExpectUntouched(simplified, 1);
}

TEST_F(NeedlessParameters, AFitWithoutCovarianceOrUseStays) {
  SetExponent(0, 1.009, 0.02);
  ASSERT_EQ(Simplified(true, false).needless.size(), 1u);
  const LuminaireFit given = fit_;
  fit_.status = FitStatus::kUndetermined;
  EXPECT_TRUE(Simplified(true, false).needless.empty());
  fit_ = given;
  fit_.covariance.resize(0, 0);
  EXPECT_TRUE(Simplified(true, false).needless.empty());
}

}  // namespace
}  // namespace luxfit
