#include "inverse/albedo/internal/albedo_rgb.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/inverse/cube_photos.h"

namespace luxfit {
namespace {

// A dark cube, so that its uneven interreflection, a tenth of itself and itself about rho of the light, is a
// hundredth.
class DarkCube : public testing::Test {
 protected:
  DarkCube() {
    const Eigen::Vector3d lamp(1.1, 0.9, 1.2);
    data_.dimming = {Eigen::VectorXd::Ones(1)};
    data_.observations = support::CubePhotos(cube_, lamp, rho_);
    fit_.state.luminaires.resize(1);
    fit_.state.luminaires[0].position = lamp;
    fit_.state.luminaires[0].distribution = Distribution::kIsotropic;
    fit_.state.free.resize(1);
    fit_.state.albedo = Eigen::VectorXd::Constant(1, 0.08);
    fit_.state.albedo_free = {true};
  }

  const Eigen::Vector3d rho_{0.12, 0.08, 0.04};
  Room cube_ = support::CubeRoom();
  LightData data_;
  LuminaireFit fit_;
};

TEST_F(DarkCube, EachChannelHasItsReflectance) {
  const Eigen::Matrix3Xd rgb = EstimateAlbedoRgb(cube_, data_, fit_);
  ASSERT_EQ(rgb.cols(), 1);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb(c, 0) / rho_[c], 1, 0.02) << "channel " << c;
}

TEST_F(DarkCube, WhatWasGivenIsNotEstimated) {
  fit_.state.albedo_free = {false};
  EXPECT_TRUE(EstimateAlbedoRgb(cube_, data_, fit_).array().isNaN().all());
}

TEST_F(DarkCube, AChannelWithoutLightHasNone) {
  for (Observation& o : data_.observations) o.relative_rgb[2] = 0;
  const Eigen::Matrix3Xd rgb = EstimateAlbedoRgb(cube_, data_, fit_);
  EXPECT_FALSE(std::isnan(rgb(0, 0)));
  EXPECT_TRUE(std::isnan(rgb(2, 0)));
}

}  // namespace
}  // namespace luxfit
