#include "inverse/mirror_sphere.h"

#include <gtest/gtest.h>

#include <cmath>

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

// A mirror sphere under a lamp of some size: bright where the mirrored view meets the lamp.
ImagePlane MirrorPicture(const Eigen::Vector3d& to_light, double lamp_radius_rad) {
  ImagePlane image = ImagePlane::Constant(180, 200, 3);
  for (int v = 0; v < image.rows(); ++v) {
    for (int u = 0; u < image.cols(); ++u) {
      const Eigen::Vector2d d = (Eigen::Vector2d(u, v) - kCenterPx) / kRadiusPx;
      if (d.squaredNorm() >= 1) continue;
      const Eigen::Vector3d n(d.x(), -d.y(), std::sqrt(1 - d.squaredNorm()));
      const Eigen::Vector3d seen = 2 * n.z() * n - Eigen::Vector3d::UnitZ();
      image(v, u) = seen.dot(to_light) > std::cos(lamp_radius_rad) ? 255.0F : 20.0F;
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
