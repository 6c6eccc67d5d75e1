#include "calib/luminance/luminance.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace luxfit {
namespace {

Photo Uniform(int height, int width, float red, float green, float blue) {
  Photo photo;
  photo.rgb_counts[0] = ImagePlane::Constant(height, width, red);
  photo.rgb_counts[1] = ImagePlane::Constant(height, width, green);
  photo.rgb_counts[2] = ImagePlane::Constant(height, width, blue);
  return photo;
}

TEST(LuminanceTest, IsTheWeightedSumPerSecondOfExposure) {
  const Photo photo = Uniform(1, 1, 6553.5f, 13107.0f, 32767.5f);
  const LuminanceImage image = ToRelativeLuminance(photo, 0.25);
  EXPECT_TRUE(image.valid(0, 0));
  // Single precision.
  EXPECT_NEAR(image.relative_luminance(0, 0), (0.265 * 0.1 + 0.670 * 0.2 + 0.065 * 0.5) / 0.25, 1e-6);
}

TEST(LuminanceTest, TwiceTheExposureAndTwiceTheCountsAreTheSameLuminance) {
  const float once = ToRelativeLuminance(Uniform(1, 1, 1000, 2000, 3000), 0.1).relative_luminance(0, 0);
  const float twice = ToRelativeLuminance(Uniform(1, 1, 2000, 4000, 6000), 0.2).relative_luminance(0, 0);
  EXPECT_FLOAT_EQ(once, twice);
}

TEST(LuminanceTest, BlackLevelIsSubtractedFromCountsAndFullScale) {
  LuminanceOptions options;
  options.black_level_counts = 1000;
  const LuminanceImage image = ToRelativeLuminance(Uniform(1, 1, 33267.5f, 33267.5f, 33267.5f), 1, options);
  EXPECT_NEAR(image.relative_luminance(0, 0), 0.5, 1e-6);
}

TEST(LuminanceTest, OneSaturatedChannelTakesItsNeighboursAlong) {
  Photo photo = Uniform(9, 9, 20000, 20000, 20000);
  photo.rgb_counts[2](4, 4) = 65535;
  const LuminanceImage image = ToRelativeLuminance(photo, 1);
  for (int v = 0; v < 9; ++v) {
    for (int u = 0; u < 9; ++u) {
      const bool near = std::abs(u - 4) <= 2 && std::abs(v - 4) <= 2;
      EXPECT_EQ(image.valid(v, u), !near) << u << ", " << v;
      EXPECT_EQ(image.saturated(v, u), near) << u << ", " << v;
    }
  }
}

TEST(LuminanceTest, TheMarginStopsAtTheBorderAndMayBeZero) {
  Photo photo = Uniform(3, 3, 20000, 20000, 20000);
  photo.rgb_counts[0](0, 0) = 65535;
  LuminanceOptions options;
  options.saturation_margin_px = 0;
  EXPECT_EQ(ToRelativeLuminance(photo, 1, options).valid.count(), 8);
  options.saturation_margin_px = 1;
  EXPECT_EQ(ToRelativeLuminance(photo, 1, options).valid.count(), 5);
  options.saturation_margin_px = 100;
  EXPECT_EQ(ToRelativeLuminance(photo, 1, options).valid.count(), 0);
}

TEST(LuminanceTest, DarkPixelsAreInvalidWithoutAMargin) {
  Photo photo = Uniform(3, 3, 20000, 20000, 20000);
  for (ImagePlane& plane : photo.rgb_counts) plane(1, 1) = 10;  // 1.5e-4 of full scale
  const LuminanceImage image = ToRelativeLuminance(photo, 4);
  EXPECT_FALSE(image.valid(1, 1));
  EXPECT_FALSE(image.saturated(1, 1));
  EXPECT_EQ(image.valid.count(), 8);
}

TEST(LuminanceTest, NotANumberIsInvalid) {
  Photo photo = Uniform(1, 2, 20000, 20000, 20000);
  photo.rgb_counts[1](0, 0) = std::numeric_limits<float>::quiet_NaN();
  LuminanceOptions options;
  options.saturation_margin_px = 0;
  const LuminanceImage image = ToRelativeLuminance(photo, 1, options);
  EXPECT_FALSE(image.valid(0, 0));
  EXPECT_TRUE(image.valid(0, 1));
}

TEST(LuminanceTest, FloatFilesHaveNoDarkLimit) {
  Photo photo = Uniform(1, 2, 1e-6f, 1e-6f, 1e-6f);
  photo.bits_per_channel = 32;
  photo.full_scale_counts = 1;
  photo.saturation_counts = 1000;
  for (ImagePlane& plane : photo.rgb_counts) plane(0, 1) = 0;
  const LuminanceImage image = ToRelativeLuminance(photo, 1);
  EXPECT_TRUE(image.valid(0, 0));
  EXPECT_FALSE(image.valid(0, 1));
}

TEST(LuminanceTest, RefusesWhatHasNoMeaning) {
  const Photo photo = Uniform(1, 1, 1, 1, 1);
  EXPECT_THROW(ToRelativeLuminance(photo, 0), std::invalid_argument);
  EXPECT_THROW(ToRelativeLuminance(photo, -1), std::invalid_argument);
  EXPECT_THROW(ToRelativeLuminance(photo, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(ToRelativeLuminance(Photo{}, 1), std::invalid_argument);
  LuminanceOptions options;
  options.black_level_counts = 70000;
  EXPECT_THROW(ToRelativeLuminance(photo, 1, options), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
