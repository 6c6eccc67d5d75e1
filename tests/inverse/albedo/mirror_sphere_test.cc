#include "inverse/albedo/photometric_stereo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/inverse/stereo_scene.h"

namespace luxfit {
namespace {

constexpr double kRadiusPx = 80;
const Eigen::Vector2d kCenterPx(99.3, 91.6);

PixelMask DiscMask() {
  PixelMask mask(180, 200);
  for (int v = 0; v < mask.rows(); ++v) {
    for (int u = 0; u < mask.cols(); ++u) mask(v, u) = (Eigen::Vector2d(u, v) - kCenterPx).norm() < kRadiusPx;
  }
  return mask;
}

ImagePlane MirrorPicture(const Eigen::Vector3d& to_light, double lamp_radius_rad) {
  ImagePlane image(180, 200);
  for (int v = 0; v < image.rows(); ++v) {
    for (int u = 0; u < image.cols(); ++u) {
      const Eigen::Vector2d offset = (Eigen::Vector2d(u, v) - kCenterPx) / kRadiusPx;
      image(v, u) = static_cast<float>(support::MirrorValue(offset, to_light, lamp_radius_rad));
    }
  }
  return image;
}

TEST(MirrorSphere, CircleOfADisc) {
  const SphereCircle circle = CircleOfMask(DiscMask());
  ASSERT_TRUE(circle.IsUsable()) << circle.message;
  // Counting pixels averages their rounding out.
  EXPECT_NEAR(circle.center_px.x(), kCenterPx.x(), 0.05);
  EXPECT_NEAR(circle.center_px.y(), kCenterPx.y(), 0.05);
  EXPECT_NEAR(circle.radius_px, kRadiusPx, 0.05);
}

TEST(MirrorSphere, HalfADiscIsNoCircle) {
  PixelMask mask = DiscMask();
  mask.leftCols(90).setConstant(false);
  EXPECT_FALSE(CircleOfMask(mask).IsUsable());
  EXPECT_FALSE(CircleOfMask(PixelMask::Constant(20, 20, false)).IsUsable());
}

TEST(MirrorSphere, DirectionWithinItsSigma) {
  const SphereCircle circle = CircleOfMask(DiscMask());
  for (const Eigen::Vector3d& direction : {Eigen::Vector3d(0.1, 0.05, 1), Eigen::Vector3d(0.5, 0.4, 0.7),
                                           Eigen::Vector3d(-0.6, 0.2, 0.5), Eigen::Vector3d(0, -0.7, 0.7)}) {
    const Eigen::Vector3d to_light = direction.normalized();
    const MirrorDirection found = LightOnMirrorSphere(MirrorPicture(to_light, 0.08), circle);
    ASSERT_TRUE(found.IsUsable()) << found.message;
    EXPECT_LT(std::acos(std::min(1.0, found.to_light.dot(to_light))), found.sigma_rad);
    EXPECT_LT(found.sigma_rad, 0.04);
  }
}

TEST(MirrorSphere, NoHighlightIsSaid) {
  const SphereCircle circle = CircleOfMask(DiscMask());
  EXPECT_FALSE(LightOnMirrorSphere(ImagePlane::Zero(180, 200), circle).IsUsable());
  // Only the rim shows a lamp far behind.
  const MirrorDirection rim =
      LightOnMirrorSphere(MirrorPicture(Eigen::Vector3d(0.2, 0, -1).normalized(), 0.08), circle);
  EXPECT_FALSE(rim.IsUsable());
}

}  // namespace
}  // namespace luxfit
