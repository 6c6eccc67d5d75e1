#include "inverse/model/internal/search/lobes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "forward/light/room.h"
#include "inverse/model/internal/search/lit_places.h"
#include "inverse/model/light_state.h"
#include "tests/support/closed_forms.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

Eigen::Vector3d AnyDirection(std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(rng), normal(rng), normal(rng)).normalized();
}

double AngleRad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

TEST(AimsOverSphere, AreUnitVectorsOfWhichOneIsNearEveryDirection) {
  const std::vector<Eigen::Vector3d>& aims = AimsOverSphere();
  ASSERT_EQ(aims.size(), 42u);
  for (const Eigen::Vector3d& aim : aims) EXPECT_NEAR(aim.norm(), 1, 1e-12);
  std::mt19937_64 rng = support::TestRng();
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d direction = AnyDirection(rng);
    double nearest = M_PI;
    for (const Eigen::Vector3d& aim : aims) nearest = std::min(nearest, AngleRad(aim, direction));
    // A triangle's centre is 36 deg / sqrt(3) from its corners on a plane, and a little less on the sphere.
    EXPECT_LT(nearest, 36.0 / std::sqrt(3.0) * M_PI / 180);
  }
}

TEST(LobesNear, TurnTheAimByTheAngleAndChangeTheWidthByTheFactor) {
  std::mt19937_64 rng = support::TestRng();
  const Lobe lobe{Distribution::kCosinePower, 8, AnyDirection(rng)};
  const std::vector<Lobe> near = LobesNear(lobe, 0.3, 2);
  ASSERT_EQ(near.size(), 21u);
  for (size_t i = 0; i < near.size(); ++i) {
    EXPECT_NEAR(AngleRad(near[i].aim, lobe.aim), i % 7 == 0 ? 0 : 0.3, 1e-12);
    EXPECT_EQ(near[i].exponent, i < 7 ? 8 : (i < 14 ? 16 : 4));
  }
  EXPECT_EQ(LobesNear({Distribution::kIsotropic, 1, {0, 0, -1}}, 0.3, 2).size(), 1u);
  for (const Lobe& narrow : LobesNear({Distribution::kCosinePower, kGreatestCosinePower, {1, 0, 0}}, 0.3, 2))
    EXPECT_LE(narrow.exponent, kGreatestCosinePower);
}

// Sensors straight below and above the place, at 2 and 1 m, face it.
TEST(LobeColumns, ShineUpAndDownWhereBothSidesAreSeen) {
  const Room room = MakeRoom(Scene{});
  const Sensor below{{0, 0, 0}, {0, 0, 1}}, above{{0, 0, 3}, {0, 0, -1}};
  for (const double up : {0.5, 0.3}) {
    const Lobe lobe{Distribution::kCosinePower, 1, {0, 0, -1}, up};
    const auto column = [&](const std::vector<Sensor>& sensors) {
      return LobeColumns(Lit(room, sensors, {{0, 0, 2}}).light[0], {lobe});
    };
    const Eigen::MatrixXf both = column({below, above});
    EXPECT_NEAR(both(0, 0), (1 - up) / support::kPi / 4, 1e-7);
    EXPECT_NEAR(both(1, 0), up / support::kPi, 1e-7);
    EXPECT_EQ(column({below})(0, 0), 0);
  }
}

// A sensor below the middle of a Lambertian line:  pi E = int h^2 / (h^2 + x^2)^2 dx / (2 a) = (a / (h^2 + a^2) + atan(a / h) / h) / (2 a)
TEST(LobeColumns, OfALineAreItsIntegral) {
  const Room room = MakeRoom(Scene{});
  const double a = 0.75, h = 1;
  const LitPlaces line = LitAlong(room, {{{0, 0, 0}, {0, 0, 1}}}, {0, 0, h}, {0, a, 0});
  const double lx = (a / (h * h + a * a) + std::atan(a / h) / h) / (2 * a) / support::kPi;
  EXPECT_NEAR(LobeColumns(line.light[0], {{}})(0, 0), lx, 0.006 * lx);  // the middles of fifths: +0.53 %
}

// A sensor 2 m below the place and 1 m aside faces up.
TEST(LobeColumns, FollowTheInverseSquareAndCosineLawForAnyAimAndWidth) {
  const Room room = MakeRoom(Scene{});
  const Eigen::Vector3d place(0.3, -0.2, 2.4), ray = Eigen::Vector3d(1, 0, -2).normalized();
  const LitPlaces lit = Lit(room, {{place + std::sqrt(5.0) * ray, {0, 0, 1}}}, {place});
  std::mt19937_64 rng = support::TestRng();
  std::vector<Lobe> lobes = SimpleLobes();
  for (const double exponent : {1.0, 2.0, 8.0, 13.0, 32.0, 7.3}) {
    for (int i = 0; i < 4; ++i) lobes.push_back({Distribution::kCosinePower, exponent, AnyDirection(rng)});
    lobes.push_back({Distribution::kCosinePower, exponent, ray});
  }
  const Eigen::MatrixXf column = LobeColumns(lit.light[0], lobes);
  for (size_t l = 0; l < lobes.size(); ++l) {
    const double m = lobes[l].exponent, cosine = std::max(0.0, lobes[l].aim.dot(ray));
    const double cd_per_lm = lobes[l].distribution == Distribution::kIsotropic
                                 ? 1 / (4 * support::kPi)
                                 : (m + 1) / (2 * support::kPi) * std::pow(cosine, m);
    const double lx = cd_per_lm * 2 / std::sqrt(5.0) / 5;
    // Cosines and powers are of single precision.
    EXPECT_NEAR(column(0, static_cast<Eigen::Index>(l)), lx, 1e-5 * lx + 1e-9) << "lobe " << l;
  }
}

}  // namespace
}  // namespace luxfit
