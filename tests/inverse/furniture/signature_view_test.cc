#include "inverse/furniture/signature_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "inverse/furniture/internal/signature.h"

namespace luxfit {
namespace {

Camera CameraOf(int width, int height) {
  Camera camera;
  camera.width_px = width, camera.height_px = height;
  camera.fx_px = camera.fy_px = 0.8 * width;
  camera.cx_px = 0.5 * (width - 1), camera.cy_px = 0.5 * (height - 1);
  return camera;
}

// A photo whose luminance is exp(column / 100), so that its logarithm is even over small windows.
LuminanceImage Ramp(const Camera& camera, double gain) {
  LuminanceImage photo;
  photo.relative_luminance.resize(camera.height_px, camera.width_px);
  for (int u = 0; u < camera.width_px; ++u)
    photo.relative_luminance.col(u).setConstant(static_cast<float>(gain * std::exp(0.01 * u)));
  photo.variance = 1e-4F * photo.relative_luminance.square();
  photo.valid = PixelMask::Constant(camera.height_px, camera.width_px, true);
  return photo;
}

float At(const SignatureView& view, int u, int v, int state) {
  return view.log_luminance[static_cast<size_t>((v * view.width_px + u) * view.states + state)];
}

TEST(SignatureView, ASmallPhotoKeepsItsSizeAndItsLuminance) {
  const Camera camera = CameraOf(60, 40);
  const LuminanceImage a = Ramp(camera, 1), b = Ramp(camera, 2);
  const SignatureView view = MakeSignatureView(camera, Eigen::Isometry3d::Identity(), {&a, nullptr, &b});
  ASSERT_EQ(view.width_px, 60);
  ASSERT_EQ(view.height_px, 40);
  ASSERT_EQ(view.states, 3);
  EXPECT_NEAR(At(view, 30, 20, 0), 0.30, 1e-4);
  EXPECT_TRUE(std::isnan(At(view, 30, 20, 1)));
  EXPECT_NEAR(At(view, 30, 20, 2), 0.30 + std::log(2), 1e-4);
  // Nine pixels are averaged.
  EXPECT_NEAR(view.variance[static_cast<size_t>((20 * 60 + 30) * 3)], 1e-4 / 9, 1e-7);
}

TEST(SignatureView, ALargePhotoShrinksAboutItsPrincipalPoint) {
  const Camera camera = CameraOf(1920, 1080);
  const LuminanceImage photo = Ramp(camera, 1);
  const SignatureView view = MakeSignatureView(camera, Eigen::Isometry3d::Identity(), {&photo});
  ASSERT_EQ(view.width_px, kSignatureWidthPx);
  // Pixel u of the small picture covers pixels 4 u to 4 u + 3.
  EXPECT_NEAR(At(view, 100, 135, 0), 0.01 * 401.5, 1e-3);
}

TEST(SignatureView, DistortionIsTakenOut) {
  Camera camera = CameraOf(480, 360);
  camera.distortion[0] = -0.1;
  const LuminanceImage photo = Ramp(camera, 1);
  const SignatureView view = MakeSignatureView(camera, Eigen::Isometry3d::Identity(), {&photo});
  const Eigen::Vector3d ray = view.pixel_from_ray.inverse() * Eigen::Vector3d(400, 180, 1);
  EXPECT_NEAR(At(view, 400, 180, 0), 0.01 * Project(camera, ray).x(), 1e-3);
}

TEST(SignatureView, PixelsThatAreNotValidAreUnknown) {
  const Camera camera = CameraOf(60, 40);
  LuminanceImage photo = Ramp(camera, 1);
  photo.valid(20, 30) = false;
  const SignatureView view = MakeSignatureView(camera, Eigen::Isometry3d::Identity(), {&photo});
  EXPECT_TRUE(std::isnan(At(view, 31, 21, 0)));
  EXPECT_TRUE(std::isfinite(At(view, 33, 20, 0)));
}

TEST(Signatures, NoiseWidensTheToleranceOfEachState) {
  const Camera camera = CameraOf(60, 40);
  const LuminanceImage a = Ramp(camera, 1), b = Ramp(camera, 1.03);
  const SignatureView clean = MakeSignatureView(camera, Eigen::Isometry3d::Identity(), {&a, &a, &a});
  SignatureView brighter = MakeSignatureView(camera, Eigen::Isometry3d::Identity(), {&b, &b, &b});
  Signatures signatures(3);
  ASSERT_TRUE(signatures.Add(clean, 30, 20));
  ASSERT_TRUE(signatures.Add(brighter, 30, 20));
  EXPECT_FALSE(signatures.Agree(0, 1, 0.015));  // 3 % apart
  EXPECT_TRUE(signatures.Agree(0, 1, 0.035));
  brighter.variance.assign(brighter.variance.size(), 0.03F * 0.03F);
  ASSERT_TRUE(signatures.Add(brighter, 30, 20));
  EXPECT_TRUE(signatures.Agree(0, 2, 0.015));
}

TEST(Signatures, TooFewStatesTellNothing) {
  const Camera camera = CameraOf(60, 40);
  const LuminanceImage a = Ramp(camera, 1);
  const SignatureView view = MakeSignatureView(camera, Eigen::Isometry3d::Identity(), {&a, &a, nullptr});
  Signatures signatures(3);
  EXPECT_FALSE(signatures.Add(view, 30, 20));
  EXPECT_EQ(signatures.count(), 0);
}

}  // namespace
}  // namespace luxfit
