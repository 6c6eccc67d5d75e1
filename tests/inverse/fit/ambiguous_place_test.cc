// A lamp that two places explain equally: readings of sensors that look along the plane in which they lie.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "inverse/fit/fit_room.h"
#include "tests/support/closed_forms.h"
#include "tests/support/inverse/plane_readings.h"

namespace luxfit {
namespace {

const Eigen::Vector3d kLamp(0.7, -0.2, 0.9);
constexpr double kFluxLm = 800;

// E = Phi (n . d) / (4 pi r^3) of an isotropic point, on sensors at these heights that look along +x and +y.
RoomObservations SidewaysReadings(const std::vector<double>& heights) {
  RoomObservations given;
  given.dimming = {Eigen::VectorXd::Ones(1)};
  KnownLuminaire lamp;
  lamp.luminaire.id = "A";
  lamp.luminaire.distribution = Distribution::kIsotropic;
  lamp.luminaire.shape = LuminaireShape::kPoint;
  lamp.photometry = KnownPhotometry::kLobe;
  lamp.shape_is_known = true;
  lamp.aim = -Eigen::Vector3d::UnitZ();
  given.luminaires = {lamp};
  for (const double height : heights) {
    for (const Eigen::Vector3d& point : support::PlanePoints(9, 2, height)) {
      const Eigen::Vector3d p = point - Eigen::Vector3d(1.5, 1.5, 0), d = kLamp - p;
      for (const int axis : {0, 1}) {
        const Eigen::Vector3d n = Eigen::Vector3d::Unit(axis);
        if (n.dot(d) <= 0.05) continue;
        MeterReading reading;
        reading.sensor = {p, n, {}};
        reading.illuminance_lx = kFluxLm * n.dot(d) / (4 * support::kPi * std::pow(d.norm(), 3));
        reading.used = true;
        given.meter.readings.push_back(reading);
      }
    }
  }
  return given;
}

TEST(AmbiguousPlace, SigmasReachTheRival) {
  const RoomFit fit = FitRoom(MakeRoom(Scene{}), SidewaysReadings({0}));
  ASSERT_EQ(fit.ambiguous.size(), 1u);
  EXPECT_TRUE(fit.findings.IsUndetermined());
  EXPECT_TRUE(std::any_of(fit.findings.warnings.begin(), fit.findings.warnings.end(),
                          [](const Warning& w) { return w.code == "starts_disagree"; }));
  const Luminaire& lamp = fit.fit.state.luminaires[0];
  EXPECT_NEAR(std::abs(lamp.position.z()), kLamp.z(), 0.02);
  EXPECT_NEAR(SigmaOf(fit, ParameterKind::kLuminaire, 0, LuminaireQuantity::kPositionZ), 2 * kLamp.z(), 0.03);
  EXPECT_LT(SigmaOf(fit, ParameterKind::kLuminaire, 0, LuminaireQuantity::kPositionX), 0.05) << "told";
  EXPECT_LT(SigmaOf(fit, ParameterKind::kLogFlux, 0), 0.05) << "told";
  EXPECT_NEAR(EstimatedLuminaires(fit)[0].position_sigma_m.z(), 2 * kLamp.z(), 0.03);
}

TEST(AmbiguousPlace, ASecondPlaneOfSensorsSettlesIt) {
  const RoomFit fit = FitRoom(MakeRoom(Scene{}), SidewaysReadings({0, 0.4}));
  EXPECT_TRUE(fit.ambiguous.empty());
  EXPECT_FALSE(fit.findings.IsUndetermined());
  EXPECT_LT((fit.fit.state.luminaires[0].position - kLamp).norm(), 0.01);
  EXPECT_LT(SigmaOf(fit, ParameterKind::kLuminaire, 0, LuminaireQuantity::kPositionZ), 0.05);
}

// A luminaire without light may be anywhere, whatever direction the fit names.
TEST(SigmaOfAParameter, IsUnknownWhereItHasNoMeaning) {
  LuminaireFit fit;
  Parameter x, y;
  y.quantity = LuminaireQuantity::kPositionY;
  fit.parameters = {x, y};
  fit.covariance = Eigen::Vector2d(1e54, 1e-4).asDiagonal();
  EXPECT_TRUE(std::isnan(SigmaOf(fit, ParameterKind::kLuminaire, 0, LuminaireQuantity::kPositionX)));
  EXPECT_DOUBLE_EQ(SigmaOf(fit, ParameterKind::kLuminaire, 0, LuminaireQuantity::kPositionY), 0.01);
}

TEST(FluxOfALuminaire, IsUnknownWhereItMayBeThreeTimesAsLarge) {
  RoomFit fit;
  fit.absolute = true;
  fit.fit.state.luminaires.resize(1);
  fit.fit.state.luminaires[0].id = "A";
  fit.fit.state.free.resize(1);
  fit.fit.parameters.push_back({ParameterKind::kLogFlux, 0, {}, -50, 50, "A"});
  fit.fit.covariance = Eigen::MatrixXd::Constant(1, 1, 0.81);
  EXPECT_TRUE(IsFluxKnown(fit, 0));
  fit.fit.covariance(0, 0) = 1.21;
  EXPECT_FALSE(IsFluxKnown(fit, 0));
  fit.fit.covariance(0, 0) = 0.01;
  fit.fit.at_bound = {{ParameterKind::kLogFlux, "A"}};
  EXPECT_FALSE(IsFluxKnown(fit, 0)) << "it stopped at a bound";
}

}  // namespace
}  // namespace luxfit
