#include "calib/calibrate/rig_strain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/support/calib/board_views.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr int kSets = 12;

CalibrateCamerasOptions OneLens() {
  CalibrateCamerasOptions options;
  options.lenses = {*LensKindOf("opencv5")};
  return options;
}

// Two cameras 0.12 m apart; noise 0.3 px. The second camera turns between sets by as much as moves its picture by `jitter_px`
// (1 sigma per axis); that of set 5 by `jump_px` more.
CalibrationInput Rig(double jitter_px, double jump_px, std::mt19937_64& rng) {
  support::BoardViewsOptions views;
  views.images = kSets;
  Eigen::Isometry3d second = Eigen::Isometry3d::Identity();
  second.translation().x() = -0.12;
  CalibrationInput input =
      support::BoardViews(support::GridTarget(), {support::OpenCv8Camera(), support::OpenCv8Camera()},
                          {Eigen::Isometry3d::Identity(), second}, views, rng)
          .input();
  std::normal_distribution<double> jitter(0, 1);
  for (CalibrationImage& image : input.images) {
    if (image.camera != 1) continue;
    Eigen::Vector2d shift = jitter_px * Eigen::Vector2d(jitter(rng), jitter(rng));
    if (image.set == 5) shift.x() += jump_px;
    for (BoardCorner& corner : image.corners) corner.pixel += shift;
  }
  return input;
}

RigStrain StrainWith(double jitter_px, double jump_px, std::mt19937_64& rng) {
  const CalibrationInput input = Rig(jitter_px, jump_px, rng);
  const Calibration rig = CalibrateCameras(input, OneLens());
  EXPECT_TRUE(rig.converged) << rig.message;
  const RigStrain strain = StrainOf(input, rig, OneLens());
  std::printf("jitter %.1f px: together %.3f px, alone %.3f px\n", jitter_px, strain.together_px,
              strain.alone_px);
  return strain;
}

TEST(RigStrain, AFixedRigHasTheNoiseOfItsCameras) {
  auto rng = support::TestRng();
  const RigStrain strain = StrainWith(0, 0, rng);
  // 24 images of about a hundred corners know the noise of 0.3 px to 1 %; five of these.
  EXPECT_NEAR(strain.together_px, 0.3, 0.015);
  EXPECT_NEAR(strain.alone_px, 0.3, 0.015);
  EXPECT_FALSE(strain.IsStrained());
}

TEST(RigStrain, CamerasThatMoveAgainstEachOtherAreTold) {
  auto rng = support::TestRng();
  const RigStrain strain = StrainWith(1, 0, rng);
  EXPECT_NEAR(strain.alone_px, 0.3, 0.015) << "each board's pose takes up the shift of its image";
  EXPECT_TRUE(strain.IsStrained());
  EXPECT_FALSE(StrainWith(0.2, 0, rng).IsStrained()) << "far below the noise";
}

TEST(RigStrain, TheSetThatSuffersMostIsNamed) {
  auto rng = support::TestRng();
  const CalibrationInput input = Rig(0, 1.5, rng);
  const RigStrain strain = StrainOf(input, CalibrateCameras(input, OneLens()), OneLens());
  std::vector<int> sets;
  for (const int image : strain.worst_images)
    sets.push_back(input.images[static_cast<std::size_t>(image)].set);
  EXPECT_THAT(sets, testing::ElementsAre(5, 5));
}

TEST(RigStrain, OneCameraOfARigKeepsItsImages) {
  auto rng = support::TestRng();
  const CalibrationInput input = Rig(0, 0, rng);
  const CalibrationInput second = InputOfCamera(input, 1);
  ASSERT_EQ(second.cameras.size(), 1U);
  EXPECT_EQ(second.cameras[0].id, "cam1");
  ASSERT_EQ(second.images.size(), static_cast<std::size_t>(kSets));
  EXPECT_EQ(second.images[3].name, "cam1_3");
  EXPECT_EQ(second.images[3].camera, 0);
}

}  // namespace
}  // namespace luxfit
