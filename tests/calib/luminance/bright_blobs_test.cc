#include "calib/luminance/bright_blobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "tests/support/calib/blur.h"

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

// Signed distance from an outline, px, positive outside.
using Outline = std::function<double(const Eigen::Vector2d&)>;

const Eigen::Vector2d kCenter(70.3, 50.8);
constexpr double kRadiusPx = 12;
const Eigen::Vector2d kHalfSizePx(20, 10);

Outline DiscOf(const Eigen::Vector2d& center) {
  return [center](const Eigen::Vector2d& p) { return (p - center).norm() - kRadiusPx; };
}

// Returns the distance beyond each pair of sides of a rectangle turned by 17 degrees about kCenter.
Eigen::Vector2d BeyondSides(const Eigen::Vector2d& p) {
  const double turn = 17 * kPi / 180;
  const Eigen::Vector2d from = p - kCenter;
  return Eigen::Vector2d(std::cos(turn) * from.x() + std::sin(turn) * from.y(),
                         std::cos(turn) * from.y() - std::sin(turn) * from.x())
             .cwiseAbs() -
         kHalfSizePx;
}

double FromRectangle(const Eigen::Vector2d& p) {
  const Eigen::Vector2d beyond = BeyondSides(p);
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

bool IsNearCorner(const Eigen::Vector2d& p) { return BeyondSides(p).minCoeff() > -3; }

// Renders what lies inside on a floor of 2 % of full scale. Pixels show the mean of 8 x 8 samples, and clip.
Photo Rendered(const Outline& outline, double luminaire_counts, double blur_px) {
  constexpr int kSide = 8;
  Photo photo = Floor(200, 120);
  ImagePlane& plane = photo.rgb_counts[0];
  plane.setConstant(0.02f * kFull);
  for (Eigen::Index v = 0; v < plane.rows(); ++v) {
    for (Eigen::Index u = 0; u < plane.cols(); ++u) {
      const Eigen::Vector2d pixel(static_cast<double>(u), static_cast<double>(v));
      if (std::abs(outline(pixel)) > 1 && outline(pixel) > 0) continue;
      int inside = 0;
      for (int i = 0; i < kSide * kSide; ++i) {
        const Eigen::Vector2d sample(i % kSide, static_cast<double>(i / kSide));
        const Eigen::Vector2d p = pixel + (sample.array() + 0.5).matrix() / kSide - Eigen::Vector2d(0.5, 0.5);
        inside += outline(p) < 0 ? 1 : 0;
      }
      plane(v, u) += static_cast<float>((luminaire_counts - 0.02 * kFull) * inside / (kSide * kSide));
    }
  }
  plane = support::Blurred(plane, blur_px).min(kFull);
  photo.rgb_counts[1] = photo.rgb_counts[2] = plane;
  return photo;
}

// Returns the contour of the largest blob.
std::vector<Eigen::Vector2d> ContourOf(const Photo& photo) {
  const auto blobs = FindBrightBlobs(ToRelativeLuminance(photo, 0.1));
  return blobs.empty() ? std::vector<Eigen::Vector2d>() : blobs[0].contour_px;
}

double MeanDistance(const std::vector<Eigen::Vector2d>& contour, const Outline& outline) {
  double sum = 0;
  for (const Eigen::Vector2d& p : contour) sum += outline(p);
  return sum / static_cast<double>(contour.size());
}

// 0.8 and 1 of full scale: not saturated, and saturated without being overexposed. Half of either is the edge's own
// mean to 1 % of the step. Blur of 1 px moves the edge of a disc of radius 12 inwards by 1 / 24 px.
TEST(FindBrightBlobs, TheContourOfADiscIsItsOutline) {
  for (const double share : {0.8, 1.0}) {
    for (const double blur_px : {0.0, 1.0}) {
      const auto contour = ContourOf(Rendered(DiscOf(kCenter), share * kFull, blur_px));
      ASSERT_GE(contour.size(), 24u) << share << " " << blur_px;
      for (const Eigen::Vector2d& p : contour)
        EXPECT_LT(std::abs(DiscOf(kCenter)(p)), blur_px > 0 ? 0.35 : 0.2)
            << share << ", " << blur_px << " px";
      EXPECT_NEAR(MeanDistance(contour, DiscOf(kCenter)), 0, 0.06) << share << ", " << blur_px << " px";
    }
  }
}

// Pixels and blur round the corners: where two edges meet, half the luminance lies 0.55 sigma inside of both. A
// pixel interpolated bilinearly blurs by half a pixel.
TEST(FindBrightBlobs, TheContourOfATurnedRectangleIsItsOutline) {
  for (const double share : {0.8, 1.0}) {
    for (const double blur_px : {0.0, 1.0}) {
      const auto contour = ContourOf(Rendered(FromRectangle, share * kFull, blur_px));
      ASSERT_GE(contour.size(), 24u) << share << " " << blur_px;
      std::vector<Eigen::Vector2d> of_sides;
      for (const Eigen::Vector2d& p : contour) {
        const double distance_px = std::abs(FromRectangle(p)), allowed_px = blur_px > 0 ? 0.35 : 0.2;
        EXPECT_LT(distance_px, IsNearCorner(p) ? 2.5 * allowed_px : allowed_px)
            << share << ", " << blur_px << " px";
        if (!IsNearCorner(p)) of_sides.push_back(p);
      }
      ASSERT_GE(of_sides.size(), 16u);
      EXPECT_NEAR(MeanDistance(of_sides, FromRectangle), 0, 0.06) << share << ", " << blur_px << " px";
    }
  }
}

// At twice full scale, the sensor's half is a quarter of the luminaire. A blur of 1 px shows that 0.7 px outside.
TEST(FindBrightBlobs, BlurMovesAnOverexposedContourOutwardsByAFractionOfAPixel) {
  const auto contour = ContourOf(Rendered(DiscOf(kCenter), 2 * kFull, 1));
  ASSERT_GE(contour.size(), 24u);
  EXPECT_NEAR(MeanDistance(contour, DiscOf(kCenter)), 0.7, 0.2);
}

TEST(FindBrightBlobs, ThePhotosEdgeIsNoContour) {
  for (const Eigen::Vector2d& center : {Eigen::Vector2d(4.2, 60.3), Eigen::Vector2d(198.4, 50.7),
                                        Eigen::Vector2d(100.2, 1.6), Eigen::Vector2d(60.1, 119.2)}) {
    const auto contour = ContourOf(Rendered(DiscOf(center), kFull, 0));
    ASSERT_GE(contour.size(), 8u) << center.transpose();
    for (const Eigen::Vector2d& p : contour) {
      const double from_edge_px =
          std::min((p.array() + 0.5).minCoeff(), (Eigen::Array2d(199.5, 119.5) - p.array()).minCoeff());
      EXPECT_GT(from_edge_px, 3) << center.transpose() << ": " << p.transpose();
      EXPECT_LT(std::abs(DiscOf(center)(p)), 0.2);
    }
  }
}

// The contour of 2 x 2 pixels has their four corners. Along a row of pixels it returns on itself, and its two ends have
// no normal: 4 x 1 pixels leave two points on either side, 1 x 5 leave three.
TEST(FindBrightBlobs, FourPixelsHaveAContourToo) {
  for (const Eigen::Vector2i& size : {Eigen::Vector2i(2, 2), Eigen::Vector2i(4, 1), Eigen::Vector2i(1, 5)}) {
    Photo photo = Floor(60, 40);
    for (ImagePlane& plane : photo.rgb_counts) plane.block(20, 30, size.y(), size.x()).setConstant(kFull);
    const auto blobs = FindBrightBlobs(ToRelativeLuminance(photo, 0.1));
    ASSERT_EQ(blobs.size(), 1u) << size.transpose();
    EXPECT_EQ(blobs[0].area_px2, size.prod());
    const std::vector<Eigen::Vector2d>& contour = blobs[0].contour_px;
    ASSERT_GE(contour.size(), 4u) << size.transpose();
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& p : contour) {
      mean += p / static_cast<double>(contour.size());
      EXPECT_LT((p - blobs[0].center_px).cwiseAbs().maxCoeff(), 0.5 * size.maxCoeff() + 0.5)
          << size.transpose();
    }
    // Both sides have points: the blob is symmetric. A side alone would be half a pixel off.
    EXPECT_LT((mean - blobs[0].center_px).norm(), 0.05) << size.transpose();
  }
}

// Pixels that the disc covers whole are not finite, those of its rim are.
TEST(FindBrightBlobs, WhatIsNotANumberCountsAsBright) {
  for (const float bright :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Photo photo = Rendered(DiscOf(kCenter), kFull, 0);
    for (ImagePlane& plane : photo.rgb_counts) plane /= kFull;
    photo.bits_per_channel = 32;
    photo.full_scale_counts = photo.saturation_counts = 1;
    for (ImagePlane& plane : photo.rgb_counts) {
      for (Eigen::Index v = 45; v < 120; ++v) {
        for (Eigen::Index u = 0; u < plane.cols(); ++u)
          if (plane(v, u) > 0.999f) plane(v, u) = bright;
      }
    }
    const auto contour = ContourOf(photo);
    ASSERT_GE(contour.size(), 24u) << bright;
    for (const Eigen::Vector2d& p : contour) EXPECT_LT(std::abs(DiscOf(kCenter)(p)), 0.2) << bright;
  }
}

}  // namespace
}  // namespace luxfit
