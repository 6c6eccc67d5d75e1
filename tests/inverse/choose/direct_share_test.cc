#include "inverse/choose/internal/profile_direct_share.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/support/closed_forms.h"
#include "tests/support/inverse/box_paths.h"
#include "tests/support/inverse/plane_readings.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr double kFluxLm = 1000, kAlbedo = 0.6;
const Eigen::Vector3d kSize(3, 3, 2.5), kKnownLamp(1.5, 1.4, 2.4);

double DirectLx(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
  return support::PointLx(kFluxLm, support::LambertianCdPerLm, kKnownLamp, p, normal);
}

// Interreflected light by paths: E = mean over paths of sum_k rho^k D(x_k).
double IndirectLx(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, std::mt19937_64& rng) {
  constexpr int kPaths = 5000, kBounces = 14;
  std::uniform_real_distribution<double> unit;
  double sum = 0;
  for (int path = 0; path < kPaths; ++path) {
    Eigen::Vector3d at = p, facing = normal;
    double weight = 1;
    for (int bounce = 0; bounce < kBounces; ++bounce) {
      const double radial = unit(rng), azimuthal = unit(rng);
      const auto [next, wall] =
          support::HitBox(kSize, at, support::CosineWeighted(facing, radial, azimuthal));
      at = next;
      facing = wall;
      weight *= kAlbedo;
      sum += weight * DirectLx(at, facing);
    }
  }
  return sum / kPaths;
}

class DirectShareTest : public testing::Test {
 protected:
  DirectShareTest() {
    data_.dimming = {Eigen::VectorXd::Ones(1)};
    start_ = support::CosinePowerStart(kKnownLamp, 1.5);
    start_.free[0].position = false;
  }

  void Read(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
    const double direct = DirectLx(p, normal), all = direct + IndirectLx(p, normal, rng_);
    direct_ += direct;
    all_ += all;
    data_.readings.push_back({{p, normal}, 0, all, 0.01 * all, true});
  }

  // The floor, facing up.
  void ReadFloor(double width_m) {
    for (const Eigen::Vector3d& p : support::PlanePoints(5, width_m, 0.01))
      Read(p + Eigen::Vector3d(1.5, 1.5, 0), Eigen::Vector3d::UnitZ());
  }

  DirectShare Profile() {
    RoomOptions options;
    options.patches = {0.75, 0.375};
    const Room room = MakeRoom(support::ClosedRoom(kSize), options);
    start_.albedo = Eigen::VectorXd::Constant(1, 0.5);
    start_.albedo_free = {true};
    const LuminaireFit fit = FitLuminaires(room, data_, start_);
    EXPECT_TRUE(fit.IsUsable()) << fit.message;
    return ProfileDirectShare(room, data_, fit, {{true, true, false}}, {});
  }

  double TrueShare() const { return direct_ / all_; }

  std::mt19937_64 rng_ = support::TestRng();
  LightData data_;
  LightState start_;
  double direct_ = 0, all_ = 0;
};

TEST_F(DirectShareTest, ReadingsThatFaceAwayTellItApart) {
  ReadFloor(2.4);
  // Facing down: the luminaire is above them.
  for (const Eigen::Vector3d& p : support::PlanePoints(4, 2.4, 1.0))
    Read(p + Eigen::Vector3d(1.5, 1.5, 0), -Eigen::Vector3d::UnitZ());
  const DirectShare share = Profile();
  EXPECT_TRUE(share.is_determined) << share.lower << " to " << share.upper;
  EXPECT_NEAR(share.share / TrueShare(), 1, 0.05);
  EXPECT_LE(share.lower, TrueShare());
  EXPECT_GE(share.upper, TrueShare());
  EXPECT_GT(share.candidates.size(), 1u);
}

TEST_F(DirectShareTest, ReadingsUnderneathDoNot) {
  ReadFloor(0.8);
  const DirectShare share = Profile();
  EXPECT_FALSE(share.is_determined);
  EXPECT_LE(share.lower, TrueShare());
  EXPECT_GE(share.upper, TrueShare());
}

TEST_F(DirectShareTest, WithoutARoomAllLightIsDirect) {
  const auto lux = [](const Eigen::Vector3d& p) { return DirectLx(p, Eigen::Vector3d::UnitZ()); };
  data_.readings = support::ReadAt(support::PlanePoints(6, 3, 0), lux, 0.005, rng_);
  const Room nothing = MakeRoom(Scene{});
  const LuminaireFit fit = FitLuminaires(nothing, data_, start_);
  const DirectShare share = ProfileDirectShare(nothing, data_, fit, {{true, true, false}}, {});
  EXPECT_TRUE(share.is_determined);
  EXPECT_NEAR(share.share, 1, 1e-6);
}

}  // namespace
}  // namespace luxfit
