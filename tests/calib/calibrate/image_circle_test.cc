#include "calib/calibrate/image_circle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace luxfit {
namespace {

constexpr double kRadiusPx = 480, kFocalPx = kRadiusPx / (M_PI / 2);

// An equidistant lens whose circle of 180 degrees lies within a wide picture.
Camera WideCamera() {
  Camera camera;
  camera.lens = LensModel::kFisheye;
  camera.width_px = 1600;
  camera.height_px = 1000;
  camera.fx_px = camera.fy_px = kFocalPx;
  camera.cx_px = 799.5;
  camera.cy_px = 499.5;
  return camera;
}

// A photo that is lit within a radius, and dark beyond.
ImagePlane LitWithin(double radius_px, float lit = 120, float dark = 3) {
  const Camera camera = WideCamera();
  ImagePlane photo(camera.height_px, camera.width_px);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x)
      photo(y, x) = std::hypot(x - camera.cx_px, y - camera.cy_px) < radius_px ? lit : dark;
  }
  return photo;
}

double RadiusPx(const ImagePlane& photo, const std::vector<Eigen::Vector2d>& corners = {}) {
  return CircleOf(WideCamera(), corners, DisplayValues(photo, 255, false)).radius_px;
}

// A ring is as wide as a cell, and a cell that the circle touches is lit.
constexpr double kTolerancePx = 1.5 * 1600 / 96;

TEST(ImageCircle, EndsWherePhotosTurnDark) {
  EXPECT_NEAR(RadiusPx(LitWithin(kRadiusPx)), kRadiusPx, kTolerancePx);
  EXPECT_NEAR(RadiusPx(LitWithin(600)), 600, kTolerancePx) << "a lens of 225 degrees";
  EXPECT_NEAR(RadiusPx(LitWithin(400)), 400, kTolerancePx) << "one of 150 degrees";
  const ImageCircle circle = CircleOf(WideCamera(), {}, DisplayValues(LitWithin(kRadiusPx), 255, false));
  EXPECT_TRUE(circle.Holds({799.5, 499.5 - 460}));
  EXPECT_FALSE(circle.Holds({20, 500}));
}

TEST(ImageCircle, LinearCountsHaveTheSameCircleAsDisplayValues) {
  const auto linear = [](double display) { return static_cast<float>(65535 * std::pow(display, 2.2)); };
  const ImagePlane photo = LitWithin(kRadiusPx, linear(0.3), linear(0.01));
  const ImageCircle circle = CircleOf(WideCamera(), {}, DisplayValues(photo, 65535, true));
  EXPECT_NEAR(circle.radius_px, kRadiusPx, kTolerancePx);
}

TEST(ImageCircle, AStampedDateAndDarkFurnitureDoNotMoveIt) {
  ImagePlane photo = LitWithin(kRadiusPx);
  photo.block(20, 20, 60, 300) = 255;
  photo.block(550, 850, 300, 300) = 3;
  EXPECT_NEAR(RadiusPx(photo), kRadiusPx, kTolerancePx);
}

TEST(ImageCircle, HoldsEveryCornerAndSixtyDegreesBeforeABlackWall) {
  EXPECT_NEAR(RadiusPx(LitWithin(100)), kRadiusPx * 60 / 90, kTolerancePx);
  EXPECT_NEAR(RadiusPx(LitWithin(100), {{799.5 + 450, 499.5}}), 450, kTolerancePx);
}

TEST(ImageCircle, PhotosThatAreLitEverywhereHaveNone) {
  const ImagePlane photo = LitWithin(5000);
  EXPECT_TRUE(CircleOf(WideCamera(), {}, DisplayValues(photo, 255, false)).IsWholePicture());
}

TEST(ImageCircle, ALensThatDarkensTowardsTheRimHasNone) {
  ImagePlane photo = LitWithin(5000);
  const Camera camera = WideCamera();
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x)
      photo(y, x) *= static_cast<float>(1 - 0.7 * std::hypot(x - 799.5, y - 499.5) / 943);
  }
  EXPECT_TRUE(CircleOf(camera, {}, DisplayValues(photo, 255, false)).IsWholePicture());
}

TEST(ImageCircle, WithoutPhotosItIsThatOfNinetyDegrees) {
  EXPECT_NEAR(CircleOf(WideCamera(), {}, {}).radius_px, kRadiusPx, 0.01);
  EXPECT_NEAR(CircleOf(WideCamera(), {{799.5 + 520, 499.5}}, {}).radius_px, 520, 0.01);
}

TEST(ImageCircle, ANarrowCameraSeesAllOfItsPicture) {
  Camera camera = WideCamera();
  camera.fx_px = camera.fy_px = 1600;
  EXPECT_TRUE(CircleOf(camera, {}, DisplayValues(LitWithin(kRadiusPx), 255, false)).IsWholePicture());
}

}  // namespace
}  // namespace luxfit
