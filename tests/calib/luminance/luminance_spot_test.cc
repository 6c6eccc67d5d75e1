#include "calib/luminance/luminance_spot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

LuminanceImage Grey(int height, int width, float luminance) {
  LuminanceImage image;
  for (ImagePlane& plane : image.relative_rgb) plane = ImagePlane::Constant(height, width, luminance);
  image.relative_luminance = ImagePlane::Constant(height, width, luminance);
  image.valid = PixelMask::Constant(height, width, true);
  image.saturated = PixelMask::Constant(height, width, false);
  return image;
}

// Gauss's circle problem: so many points of the grid lie within the radius.
TEST(LuminanceSpot, ACircleHoldsThePixelsWhoseCentresLieInIt) {
  const LuminanceImage image = Grey(21, 31, 2.0f);
  EXPECT_EQ(MeasureSpot(image, {15, 10}, 1).pixels, 5);
  EXPECT_EQ(MeasureSpot(image, {15, 10}, 2).pixels, 13);
  EXPECT_EQ(MeasureSpot(image, {15, 10}, 5).pixels, 81);
  EXPECT_EQ(MeasureSpot(image, {15.5, 10.5}, 1).pixels, 4);
}

TEST(LuminanceSpot, ItsMeanIsThatOfTheCircle) {
  LuminanceImage image = Grey(21, 31, 2.0f);
  image.relative_luminance(10, 15) = 7;
  image.relative_luminance(0, 0) = 1000;  // outside
  const LuminanceSpot spot = MeasureSpot(image, {15, 10}, 1);
  EXPECT_DOUBLE_EQ(spot.relative_luminance, 3);
  EXPECT_DOUBLE_EQ(spot.spread, std::sqrt(5.0));  // (16 + 4) / 4
  EXPECT_DOUBLE_EQ(spot.sigma, 1);
}

// Of 400 spots of 81 pixels: the rms of z is known to 3.5 %.
TEST(LuminanceSpot, ItsSigmaIsThatOfItsError) {
  auto rng = support::TestRng();
  std::normal_distribution<float> noise(0, 0.2f);
  double squares = 0;
  for (int i = 0; i < 400; ++i) {
    LuminanceImage image = Grey(11, 11, 3.0f);
    for (float& y : image.relative_luminance.reshaped()) y += noise(rng);
    const LuminanceSpot spot = MeasureSpot(image, {5, 5}, 5);
    squares += std::pow((spot.relative_luminance - 3) / spot.sigma, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / 400), 1, 3 * 0.035);
}

// Counts that round alike do not differ, and their error is what the image states.
TEST(LuminanceSpot, EvenPixelsStillHaveTheirNoise) {
  LuminanceImage image = Grey(11, 11, 3.0f);
  image.variance = ImagePlane::Constant(11, 11, 0.01f);
  EXPECT_NEAR(MeasureSpot(image, {5, 5}, 5).sigma, 0.1 / 9, 1e-6);
}

TEST(LuminanceSpot, SaturatedAndDarkPixelsAreCounted) {
  LuminanceImage image = Grey(11, 11, 3.0f);
  image.saturated(5, 5) = true;
  image.valid(5, 5) = image.valid(5, 6) = image.valid(0, 0) = false;
  const LuminanceSpot spot = MeasureSpot(image, {5, 5}, 2);
  EXPECT_EQ(spot.saturated, 1);
  EXPECT_EQ(spot.dark, 1);
}

TEST(LuminanceSpot, ACircleOutsideOfTheImageIsRefused) {
  const LuminanceImage image = Grey(11, 21, 3.0f);
  EXPECT_NO_THROW(MeasureSpot(image, {18, 8}, 2));
  EXPECT_THROW(MeasureSpot(image, {18.5, 8}, 2), std::invalid_argument);
  EXPECT_THROW(MeasureSpot(image, {18, 8.5}, 2), std::invalid_argument);
  EXPECT_THROW(MeasureSpot(image, {1, 5}, 2), std::invalid_argument);
  EXPECT_THROW(MeasureSpot(image, {5, 5}, 0.5), std::invalid_argument);
  EXPECT_THROW(MeasureSpot(image, {std::numeric_limits<double>::quiet_NaN(), 5}, 2), std::invalid_argument);
}

// Linear in its counts, with 1 % in the lower half and 4 % in the upper one.
CameraResponse TwoSigmas() {
  const Eigen::Vector4d counts(0, 127, 128, 255), exposure(0, 127.0 / 255, 128.0 / 255, 1);
  const Eigen::Vector4d sigma(0.01, 0.01, 0.04, 0.04);
  return CameraResponse(counts, {exposure, exposure, exposure}).WithRelativeSigma({sigma, sigma, sigma});
}

TEST(LuminanceSpot, TheResponsesErrorIsThatOfTheMergedExposures) {
  const Eigen::Vector3d grey = Eigen::Vector3d::Constant(0.1);
  const LuminanceOptions options;
  EXPECT_NEAR(ResponseSigma(SrgbResponse(255), grey, {1}, options), 0.05, 1e-12);
  EXPECT_NEAR(ResponseSigma(TwoSigmas(), grey, {2}, options), 0.01, 1e-12);
  EXPECT_NEAR(ResponseSigma(TwoSigmas(), grey, {8}, options), 0.04, 1e-12);
  // By hand: (1 / 0.01 + 1 / 0.04) / (1 / 0.01^2 + 1 / 0.04^2); at 100 s the pixel is saturated.
  EXPECT_NEAR(ResponseSigma(TwoSigmas(), grey, {100, 8, 2}, options), 125.0 / 10625.0, 1e-12);
  const Eigen::Vector2d ends(0, 255), line(0, 1);
  EXPECT_EQ(ResponseSigma(CameraResponse(ends, {line, line, line}), grey, {1}, options), 0);
}

}  // namespace
}  // namespace luxfit
