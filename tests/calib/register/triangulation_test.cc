#include "calib/register/triangulation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

const std::vector<Eigen::Vector3d> kEyes = {
    {0.5, 0.5, 1.6}, {5.4, 3.6, 1.6}, {0.6, 3.4, 1.4}, {5.2, 0.4, 1.5}};

Sight SightOf(int view, const Eigen::Vector3d& p, double sigma_rad = 1e-3) {
  const Eigen::Vector3d& eye = kEyes[static_cast<size_t>(view)];
  return {view, eye, (p - eye).normalized(), sigma_rad};
}

// Turned by a Gaussian angle of sigma a direction.
Sight Noisy(Sight sight, std::mt19937_64& rng) {
  std::normal_distribution<double> noise(0, sight.sigma_rad);
  const Eigen::Vector3d a = sight.direction.unitOrthogonal();
  const Eigen::Vector3d b = sight.direction.cross(a);
  sight.direction = (sight.direction + noise(rng) * a + noise(rng) * b).normalized();
  return sight;
}

TEST(TriangulateSights, ExactRaysMeetInTheirPoint) {
  const Eigen::Vector3d p(2.1, 1.3, 2.79);
  std::vector<Sight> sights;
  for (int v = 0; v < 4; ++v) sights.push_back(SightOf(v, p));
  const auto points = TriangulateSights(sights);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_LT((points[0].position - p).norm(), 1e-9);
  EXPECT_EQ(points[0].sights, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_LT(points[0].rms_sigmas, 1e-6);
}

// e' C^-1 e is chi-squared with three degrees of freedom: its mean over 400 trials is 3 +- 0.12.
TEST(TriangulateSights, CovarianceIsThatOfManyTrials) {
  std::mt19937_64 rng = support::TestRng();
  const Eigen::Vector3d p(2.1, 1.3, 2.79);
  double sum = 0;
  int found = 0;
  constexpr int kTrials = 400;
  TriangulationOptions options;
  options.max_sigmas = 5;  // so that no view drops out
  for (int i = 0; i < kTrials; ++i) {
    std::vector<Sight> sights;
    for (int v = 0; v < 4; ++v) sights.push_back(Noisy(SightOf(v, p), rng));
    const auto points = TriangulateSights(sights, options);
    if (points.size() != 1 || points[0].sights.size() != 4) continue;
    ++found;
    const Eigen::Vector3d error = points[0].position - p;
    sum += error.dot(points[0].covariance_m2.inverse() * error);
  }
  EXPECT_GE(found, kTrials - 4);
  EXPECT_NEAR(sum / found, 3, 4 * 0.12);
}

// Two lamps and ten highlights in every photo; nobody says which is which.
TEST(TriangulateSights, PointsAreFoundAmongSightsOfNothing) {
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> x(0, 6), y(0, 4), z(0, 2.5);
  const std::vector<Eigen::Vector3d> lamps = {{1.5, 2, 2.79}, {4.2, 2.6, 2.79}};
  int wrong = 0;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Sight> sights;
    for (int v = 0; v < 4; ++v) {
      for (const Eigen::Vector3d& lamp : lamps) sights.push_back(Noisy(SightOf(v, lamp), rng));
      for (int i = 0; i < 10; ++i) sights.push_back(SightOf(v, {x(rng), y(rng), z(rng)}));
    }
    const auto points = TriangulateSights(sights);
    ASSERT_GE(points.size(), 2u);
    for (const Eigen::Vector3d& lamp : lamps) {
      const bool found =
          (points[0].position - lamp).norm() < 0.03 || (points[1].position - lamp).norm() < 0.03;
      wrong += found ? 0 : 1;
    }
  }
  EXPECT_LE(wrong, 1);  // of 40
}

// Two points half a millimetre apart are within the reach of each other's sights, 3 mm at 3 m. Each takes its own four.
TEST(TriangulateSights, ASightBelongsToOnePoint) {
  const Eigen::Vector3d p(2.1, 1.3, 2.79), beside(2.1005, 1.3, 2.79);
  std::vector<Sight> sights;
  for (int v = 0; v < 4; ++v) sights.push_back(SightOf(v, p)), sights.push_back(SightOf(v, beside));
  const auto points = TriangulateSights(sights);
  ASSERT_EQ(points.size(), 2u);
  const size_t first = (points[0].position - p).norm() < (points[1].position - p).norm() ? 0 : 1;
  EXPECT_LT((points[first].position - p).norm(), 1e-9);
  EXPECT_LT((points[1 - first].position - beside).norm(), 1e-9);
  EXPECT_EQ(points[first].sights, (std::vector<int>{0, 2, 4, 6}));
  EXPECT_EQ(points[1 - first].sights, (std::vector<int>{1, 3, 5, 7}));
}

TEST(TriangulateSights, TooFewViewsOrTooLittleParallaxIsNoPoint) {
  const Eigen::Vector3d p(2.1, 1.3, 2.79);
  EXPECT_TRUE(TriangulateSights({}).empty());
  EXPECT_TRUE(TriangulateSights({SightOf(0, p), SightOf(1, p)}).empty());
  TriangulationOptions two;
  two.min_views = 2;
  EXPECT_EQ(TriangulateSights({SightOf(0, p), SightOf(1, p)}, two).size(), 1u);
  // Three cameras within 10 cm of one another.
  std::vector<Sight> close;
  for (int v = 0; v < 3; ++v) {
    Sight sight = SightOf(0, p);
    sight.view = v;
    sight.origin += Eigen::Vector3d(0.05 * v, 0, 0);
    sight.direction = (p - sight.origin).normalized();
    close.push_back(sight);
  }
  EXPECT_TRUE(TriangulateSights(close).empty());
  // Rays that would meet behind the cameras.
  std::vector<Sight> behind;
  for (int v = 0; v < 4; ++v) {
    behind.push_back(SightOf(v, p));
    behind.back().direction *= -1;
  }
  EXPECT_TRUE(TriangulateSights(behind).empty());
}

TEST(TriangulateSights, ASigmaMustBePositive) {
  EXPECT_THROW(TriangulateSights({SightOf(0, {1, 1, 1}, 0)}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
