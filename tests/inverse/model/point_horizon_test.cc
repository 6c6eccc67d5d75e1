// Receivers at the horizon of luminaires that are one point for the model, against sums over a disc of points.
#include "inverse/model/internal/point_horizon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "forward/direct/sensor.h"
#include "forward/luminaire/luminaire.h"

namespace luxfit {
namespace {

constexpr double kLeastShare = 0.02;

Luminaire PointAt(const Eigen::Vector3d& position_m) {
  Luminaire luminaire;
  luminaire.position = position_m;
  luminaire.distribution = Distribution::kIsotropic;
  return luminaire;
}

// A receiver at the origin that faces +x.
const Sensor kReceiver{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()};

// Returns the height over the receiver's plane of the point that gives the light of a disc whose centre lies in the
// plane: the mean of what stands out, over 1000 x 1000 points.
double HeightOfEqualLight(double radius_m) {
  constexpr int kSteps = 1000;
  double sum_m = 0;
  int inside = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double x = radius_m * ((2 * i + 1.0) / kSteps - 1), y = radius_m * ((2 * j + 1.0) / kSteps - 1);
      if (x * x + y * y > radius_m * radius_m) continue;
      sum_m += std::max(0.0, x);
      ++inside;
    }
  }
  return sum_m / inside;
}

TEST(PointHorizon, APointIsThereWhereADiscOfATenthOfTheDistanceWouldGiveItsLight) {
  for (const double distance_m : {0.5, 3.0}) {
    const double height_m = HeightOfEqualLight(0.1 * distance_m);
    for (const double side : {-1, 1}) {
      const auto is_at = [&](double share) {
        const double x = side * share * height_m;
        const Eigen::Vector3d from(x, 0, std::sqrt(distance_m * distance_m - x * x));
        return IsAtHorizonOf(PointAt(from), kReceiver, kLeastShare);
      };
      EXPECT_TRUE(is_at(0.99)) << distance_m;
      EXPECT_FALSE(is_at(1.01)) << distance_m;
    }
  }
}

TEST(PointHorizon, ASphereIsThereAsLongAsThePlaneCutsIt) {
  for (const double side : {-1, 1}) {
    Luminaire globe = PointAt({side * 0.14, 0, 2});
    globe.shape = LuminaireShape::kSphere;
    globe.size_m = {0.3, 0.3};
    EXPECT_TRUE(IsAtHorizonOf(globe, kReceiver, kLeastShare));
    globe.position.x() = side * 0.16;
    EXPECT_FALSE(IsAtHorizonOf(globe, kReceiver, kLeastShare));
  }
}

// The forward model cuts a surface by the receiver's plane.
TEST(PointHorizon, SurfacesAreNot) {
  Luminaire disc = PointAt({0, 0, 2});
  disc.shape = LuminaireShape::kDisc;
  disc.size_m = {0.3, 0.3};
  EXPECT_FALSE(IsAtHorizonOf(disc, kReceiver, kLeastShare));
  disc.shape = LuminaireShape::kRectangle;
  EXPECT_FALSE(IsAtHorizonOf(disc, kReceiver, kLeastShare));
}

// A spot in a ceiling tells nothing of itself by the ceiling, which stays as good as it is.
TEST(PointHorizon, LightThatDoesNotShineThereDoesNotCount) {
  Luminaire spot = PointAt({0, 0, 2});
  spot.distribution = Distribution::kCosinePower;
  spot.cosine_exponent = 30;
  spot.aim = -Eigen::Vector3d::UnitX();
  EXPECT_FALSE(IsAtHorizonOf(spot, kReceiver, kLeastShare));
  spot.aim = -Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(IsAtHorizonOf(spot, kReceiver, kLeastShare));
}

}  // namespace
}  // namespace luxfit
