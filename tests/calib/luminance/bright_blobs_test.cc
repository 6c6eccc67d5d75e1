#include "calib/luminance/bright_blobs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace luxfit {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr float kFull = 65535;

// A grey photo of floor at 10 % of full scale.
Photo Floor(int width_px, int height_px) {
  Photo photo;
  photo.bits_per_channel = 16;
  photo.full_scale_counts = photo.saturation_counts = kFull;
  for (ImagePlane& plane : photo.rgb_counts) plane = ImagePlane::Constant(height_px, width_px, 0.1f * kFull);
  return photo;
}

void DrawDisc(Photo& photo, const Eigen::Vector2d& center, double radius_px, float counts) {
  for (Eigen::Index v = 0; v < photo.rgb_counts[0].rows(); ++v) {
    for (Eigen::Index u = 0; u < photo.rgb_counts[0].cols(); ++u) {
      if ((Eigen::Vector2d(static_cast<double>(u), static_cast<double>(v)) - center).norm() > radius_px)
        continue;
      for (ImagePlane& plane : photo.rgb_counts) plane(v, u) = counts;
    }
  }
}

TEST(FindBrightBlobs, ASaturatedDiscHasItsCentreAndArea) {
  Photo photo = Floor(200, 120);
  const Eigen::Vector2d center(70.3, 50.8);
  constexpr double kRadiusPx = 12;
  DrawDisc(photo, center, kRadiusPx, kFull);
  const auto blobs = FindBrightBlobs(ToRelativeLuminance(photo, 0.1));
  ASSERT_EQ(blobs.size(), 1u);
  EXPECT_LT((blobs[0].center_px - center).norm(), 0.1);
  // The rim of a drawn disc is uncertain by about the square root of its pixels.
  EXPECT_NEAR(blobs[0].area_px2, kPi * kRadiusPx * kRadiusPx, std::sqrt(2 * kPi * kRadiusPx));
  EXPECT_NEAR(blobs[0].extent_px.sizes().x(), 2 * kRadiusPx, 1.01);
  EXPECT_EQ(blobs[0].saturated_share, 1);
  EXPECT_FALSE(blobs[0].touches_edge);
}

// Two pixels from the photo's edge the margin of saturation touches it; the disc does not.
TEST(FindBrightBlobs, TheEdgeIsTouchedByPixelsNotByTheirMargin) {
  Photo photo = Floor(200, 120);
  DrawDisc(photo, {50, 7}, 5, kFull);    // rows 2 to 12
  DrawDisc(photo, {120, 3}, 5, kFull);   // cut
  DrawDisc(photo, {199, 80}, 5, kFull);  // cut
  const auto blobs = FindBrightBlobs(ToRelativeLuminance(photo, 0.1));
  ASSERT_EQ(blobs.size(), 3u);
  for (const BrightBlob& blob : blobs)
    EXPECT_EQ(blob.touches_edge, blob.center_px.x() > 100) << blob.center_px.transpose();
}

// Exposed so short that nothing saturates: a lamp is as bright as no surface is.
TEST(FindBrightBlobs, ALampNeedNotSaturate) {
  Photo photo = Floor(200, 120);
  DrawDisc(photo, {70, 50}, 6, 0.9f * kFull);
  const auto blobs = FindBrightBlobs(ToRelativeLuminance(photo, 0.001));
  ASSERT_EQ(blobs.size(), 1u);
  EXPECT_EQ(blobs[0].saturated_share, 0);
}

TEST(FindBrightBlobs, SurfacesAreNoBlobs) {
  Photo photo = Floor(200, 120);
  DrawDisc(photo, {70, 50}, 20, 0.3f * kFull);  // three times the floor, not saturated
  EXPECT_TRUE(FindBrightBlobs(ToRelativeLuminance(photo, 0.1)).empty());
}

// One channel of a red cloth at its limit is not what a lamp is.
TEST(FindBrightBlobs, OneChannelAloneIsNotBrightBesideALamp) {
  Photo photo = Floor(200, 120);
  for (Eigen::Index v = 60; v < 100; ++v) photo.rgb_counts[0].row(v).setConstant(kFull);
  EXPECT_EQ(FindBrightBlobs(ToRelativeLuminance(photo, 0.1)).size(), 1u);
  DrawDisc(photo, {70, 30}, 6, kFull);
  const auto blobs = FindBrightBlobs(ToRelativeLuminance(photo, 0.1));
  ASSERT_EQ(blobs.size(), 1u);
  EXPECT_NEAR(blobs[0].center_px.y(), 30, 0.1);
}

TEST(FindBrightBlobs, LargestFirstAndNotTooMany) {
  Photo photo = Floor(400, 400);
  for (int i = 0; i < 40; ++i) DrawDisc(photo, {20 + 40 * (i % 8), 20 + 60 * (i / 8)}, 2 + 0.2 * i, kFull);
  const auto blobs = FindBrightBlobs(ToRelativeLuminance(photo, 0.1));
  EXPECT_EQ(blobs.size(), 24u);
  for (size_t i = 1; i < blobs.size(); ++i) EXPECT_LE(blobs[i].area_px2, blobs[i - 1].area_px2);
}

TEST(FindBrightBlobs, NothingThatIsNotANumberComesOut) {
  Photo photo = Floor(60, 40);
  photo.bits_per_channel = 32;
  photo.full_scale_counts = photo.saturation_counts = 1;
  DrawDisc(photo, {30, 20}, 4, std::numeric_limits<float>::quiet_NaN());
  for (const BrightBlob& blob : FindBrightBlobs(ToRelativeLuminance(photo, 1)))
    EXPECT_TRUE(blob.center_px.allFinite());
  EXPECT_TRUE(FindBrightBlobs({}).empty());
  LuminanceImage uneven = ToRelativeLuminance(Floor(60, 40), 1);
  uneven.saturated.resize(3, 3);
  EXPECT_THROW(FindBrightBlobs(uneven), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
