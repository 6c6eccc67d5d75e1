#include "apps/report/encoded_image.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace luxfit {
namespace {

ImagePlane Ramp(int height, int width) {
  ImagePlane plane(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) plane(y, x) = static_cast<float>(x) / static_cast<float>(width - 1);
  }
  return plane;
}

// IEC 61966-2-1: linear 0.2140 is level 0.5 of the curve.
TEST(EncodedImage, LevelsFollowTheSrgbCurve) {
  ImagePlane plane(1, 4);
  plane << 0.0f, 0.21404f, 1.0f, std::numeric_limits<float>::quiet_NaN();
  const DisplayPicture picture = ToDisplay({plane, 2 * plane, plane}, 2 * 0.5);
  EXPECT_EQ(picture.rgb[0], 0);
  EXPECT_NEAR(picture.rgb[3], 127.5, 1);
  EXPECT_EQ(picture.rgb[6], 255);
  EXPECT_EQ(picture.rgb[9], 255);
  EXPECT_GT(picture.rgb[4], picture.rgb[3]);
}

TEST(EncodedImage, PngComesBackAsItWas) {
  const DisplayPicture picture = ToDisplay({Ramp(5, 9), 0.5f * Ramp(5, 9), 0.2f * Ramp(5, 9)}, 1);
  const cv::Mat decoded = cv::imdecode(EncodePng(picture), cv::IMREAD_COLOR);
  ASSERT_EQ(decoded.cols, 9);
  ASSERT_EQ(decoded.rows, 5);
  for (int x = 0; x < 9; ++x) {
    const cv::Vec3b bgr = decoded.at<cv::Vec3b>(2, x);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(bgr[2 - c], picture.rgb[static_cast<size_t>(3 * (2 * 9 + x) + c)]);
  }
}

TEST(EncodedImage, JpegIsReadable) {
  const DisplayPicture picture = ToDisplay({Ramp(16, 32), Ramp(16, 32), Ramp(16, 32)}, 1);
  const cv::Mat decoded = cv::imdecode(EncodeJpeg(picture), cv::IMREAD_COLOR);
  ASSERT_EQ(decoded.cols, 32);
  EXPECT_NEAR(decoded.at<cv::Vec3b>(8, 31)[1], 255, 6);
}

TEST(EncodedImage, ReducingKeepsTheMean) {
  const ImagePlane plane = Ramp(30, 60), reduced = Reduced(plane, 15);
  EXPECT_EQ(reduced.cols(), 15);
  EXPECT_EQ(reduced.rows(), 8);
  EXPECT_NEAR(reduced.mean(), plane.mean(), 1e-5);
  EXPECT_EQ(Reduced(plane, 100).cols(), 60);
}

TEST(EncodedImage, SizesThatDoNotFitAreTheProgrammers) {
  EXPECT_THROW(ToDisplay({Ramp(2, 3), Ramp(2, 4), Ramp(2, 3)}, 1), std::invalid_argument);
  EXPECT_THROW(EncodePng({2, 2, {1, 2, 3}}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
