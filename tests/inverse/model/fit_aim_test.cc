// Fits aims far from their start: no aim is out of reach, past the horizontal included. The light is a closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "tests/support/closed_forms.h"

namespace luxfit {
namespace {

constexpr double kAimedFluxLm = 900, kExponent = 2;

// Readings on a wall 2 m in front of the luminaire, which hangs at the origin.
LightData ReadingsOnAWall(const Eigen::Vector3d& aim) {
  LightData data;
  data.dimming = {Eigen::VectorXd::Ones(1)};
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) {
      const Eigen::Vector3d p(2, 0.5 * i - 2, 0.5 * j - 2);
      const double distance = p.norm(), cosine = std::max(0.0, aim.dot(p) / distance);
      const double lx = kAimedFluxLm * (kExponent + 1) / (2 * support::kPi) * std::pow(cosine, kExponent) *
                        (p.x() / distance) / (distance * distance);
      data.readings.push_back({{p, {-1, 0, 0}}, 0, lx, 0.01 * lx + 0.1, true});
    }
  }
  return data;
}

LuminaireFit FitAim(const Eigen::Vector3d& truth) {
  LightState start;
  start.luminaires.resize(1);
  start.luminaires[0].id = "A";
  start.luminaires[0].distribution = Distribution::kCosinePower;
  start.luminaires[0].cosine_exponent = kExponent;
  start.luminaires[0].flux_lm = 500;
  start.free.resize(1);
  start.free[0].position = false;
  start.free[0].tilt = true;
  start.camera_scale_free = false;
  return FitLuminaires(MakeRoom(Scene{}), ReadingsOnAWall(truth), start);
}

TEST(FitAim, ReachesAimsAtAndAboveTheHorizontalFromStraightDown) {
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(1, 0.3, -0.5), Eigen::Vector3d(1, -0.2, 0), Eigen::Vector3d(1, 0.1, 0.4)}) {
    const Eigen::Vector3d truth = direction.normalized();
    const LuminaireFit fit = FitAim(truth);
    const Luminaire& found = fit.state.luminaires[0];
    EXPECT_TRUE(fit.IsUsable()) << fit.message;
    EXPECT_LT((found.aim - truth).norm(), 1e-3) << found.aim.transpose();
    EXPECT_NEAR(found.flux_lm / kAimedFluxLm, 1, 1e-3);
    EXPECT_NEAR(found.heading.dot(found.aim), 0, 1e-9);
    EXPECT_NEAR(found.heading.norm(), 1, 1e-9);
    EXPECT_TRUE(fit.at_bound.empty());
  }
}

}  // namespace
}  // namespace luxfit
