#include "calib/calibrate/rig_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

CalibratedCamera Turned(const Eigen::Vector3d& rotation_rad, const Eigen::Vector3d& translation_m) {
  CalibratedCamera camera;
  camera.cam_from_rig.linear() =
      Eigen::AngleAxisd(rotation_rad.norm(), rotation_rad.normalized()).toRotationMatrix();
  camera.cam_from_rig.translation() = translation_m;
  return camera;
}

TEST(RigPose, TheFirstCameraStandsAtItself) {
  const RigPose pose = RigPoseOf(CalibratedCamera());
  EXPECT_EQ(pose.baseline_m, 0);
  EXPECT_EQ(pose.baseline_sigma_m, 0);
  EXPECT_EQ(pose.angle_rad, 0);
  EXPECT_EQ(pose.angle_sigma_rad, 0);
}

TEST(RigPose, AnUnknownCovarianceGivesNoSigma) {
  CalibratedCamera camera = Turned({0, 0.2, 0}, {0.1, 0, 0});
  camera.cam_from_rig_covariance.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(std::isnan(RigPoseOf(camera).baseline_sigma_m));
  EXPECT_TRUE(std::isnan(RigPoseOf(camera).angle_sigma_rad));
}

// Poses are drawn from the covariance, and measured.
TEST(RigPose, SigmasAreThoseOfPosesDrawnFromTheCovariance) {
  auto rng = support::TestRng();
  std::normal_distribution<double> normal;
  CalibratedCamera camera = Turned({0.1, 0.4, -0.2}, {-0.12, 0.05, 0.02});
  const Eigen::Matrix<double, 6, 6> root =
      1e-3 * Eigen::Matrix<double, 6, 6>::NullaryExpr([&] { return normal(rng); });
  camera.cam_from_rig_covariance = root * root.transpose();
  const RigPose pose = RigPoseOf(camera);
  EXPECT_NEAR(pose.baseline_m, std::sqrt(0.0144 + 0.0025 + 0.0004), 1e-12);
  EXPECT_NEAR(pose.angle_rad, std::sqrt(0.01 + 0.16 + 0.04), 1e-12);
  constexpr int kDraws = 20000;
  double baseline_square = 0, angle_square = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Eigen::Matrix<double, 6, 1> error =
        root * Eigen::Matrix<double, 6, 1>::NullaryExpr([&] { return normal(rng); });
    const Eigen::Vector3d w = error.head<3>();
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(w.norm(), w.normalized()) * camera.cam_from_rig.linear();
    baseline_square +=
        std::pow((camera.cam_from_rig.translation() + error.tail<3>()).norm() - pose.baseline_m, 2);
    angle_square += std::pow(Eigen::AngleAxisd(turn).angle() - pose.angle_rad, 2);
  }
  // The sigma of 20000 draws is known to 0.5 %; four of these.
  EXPECT_NEAR(std::sqrt(baseline_square / kDraws) / pose.baseline_sigma_m, 1, 0.02);
  EXPECT_NEAR(std::sqrt(angle_square / kDraws) / pose.angle_sigma_rad, 1, 0.02);
}

}  // namespace
}  // namespace luxfit
