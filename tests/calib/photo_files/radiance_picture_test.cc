#include "calib/photo_files/radiance_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <stdexcept>

#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// A mantissa has 8 bits, the first of which is set in the largest channel: OpenCV reads the lower end of its step.
constexpr double kRgbeStep = 1.0 / 128;

class RadiancePictureTest : public testing::Test {
 protected:
  // Eight decades, with runs of equal pixels.
  static std::array<ImagePlane, 3> Picture(int height, int width) {
    std::mt19937_64 rng(3);
    std::uniform_real_distribution<float> decade(-4, 4), colour(0.2f, 1);
    std::array<ImagePlane, 3> rgb;
    for (ImagePlane& plane : rgb) plane = ImagePlane::Zero(height, width);
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        const bool repeats = u > 0 && (u / 16) % 2 == 1;
        const float level = std::pow(10.0f, decade(rng));
        for (ImagePlane& plane : rgb) plane(v, u) = repeats ? plane(v, u - 1) : level * colour(rng);
      }
    }
    return rgb;
  }

  // Expects that OpenCV reads what was written.
  void ExpectReadBack(const std::array<ImagePlane, 3>& rgb) {
    const std::string path = folder_.Path("a.hdr");
    WriteRadiancePicture(path, rgb, {"EXPOSURE= 1"});
    const cv::Mat read = cv::imread(path, cv::IMREAD_UNCHANGED);
    ASSERT_EQ(read.type(), CV_32FC3);
    ASSERT_EQ(read.rows, rgb[0].rows());
    ASSERT_EQ(read.cols, rgb[0].cols());
    for (int v = 0; v < read.rows; ++v) {
      for (int u = 0; u < read.cols; ++u) {
        const cv::Vec3f& bgr = read.at<cv::Vec3f>(v, u);
        const float largest = std::max({rgb[0](v, u), rgb[1](v, u), rgb[2](v, u)});
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(bgr[2 - c], rgb[static_cast<size_t>(c)](v, u), kRgbeStep * largest) << u << ", " << v;
      }
    }
  }

  TempFolder folder_;
};

TEST_F(RadiancePictureTest, OpenCvReadsEveryPixelWithinAStep) { ExpectReadBack(Picture(7, 300)); }

TEST_F(RadiancePictureTest, NarrowPicturesAreFlat) { ExpectReadBack(Picture(5, 3)); }

TEST_F(RadiancePictureTest, OneColourIsShort) {
  std::array<ImagePlane, 3> rgb;
  for (ImagePlane& plane : rgb) plane = ImagePlane::Constant(100, 1000, 0.3f);
  ExpectReadBack(rgb);
  // Four channels of eight runs, two bytes each, and four bytes a scanline.
  EXPECT_LT(folder_.Read("a.hdr").size(), 100u * (4 * 8 * 2 + 4) + 200u);
}

TEST_F(RadiancePictureTest, TheHeaderIsThatOfRadiance) {
  WriteRadiancePicture(folder_.Path("a.hdr"), Picture(5, 9), {"VIEW= -vtv -vh 40 -vv 30", "EXPOSURE= 1"});
  EXPECT_THAT(folder_.Read("a.hdr"), StartsWith("#?RADIANCE\nVIEW= -vtv -vh 40 -vv 30\nEXPOSURE= 1\n"
                                                "FORMAT=32-bit_rle_rgbe\n\n-Y 5 +X 9\n"));
}

TEST_F(RadiancePictureTest, OpenCvReadsHeadersOfAnyLength) {
  for (const size_t length : {126, 127, 128, 253, 254, 255}) {
    WriteRadiancePicture(folder_.Path("a.hdr"), Picture(5, 9), {std::string(length, 'a'), "EXPOSURE= 1"});
    EXPECT_EQ(cv::imread(folder_.Path("a.hdr"), cv::IMREAD_UNCHANGED).cols, 9) << length;
  }
}

TEST_F(RadiancePictureTest, WhatIsNoLightIsBlack) {
  std::array<ImagePlane, 3> rgb = Picture(2, 9);
  rgb[0](0, 0) = rgb[1](0, 0) = rgb[2](0, 0) = std::numeric_limits<float>::quiet_NaN();
  rgb[0](1, 1) = -1;
  WriteRadiancePicture(folder_.Path("a.hdr"), rgb, {});
  const cv::Mat read = cv::imread(folder_.Path("a.hdr"), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::norm(read.at<cv::Vec3f>(0, 0)), 0);
  EXPECT_EQ(read.at<cv::Vec3f>(1, 1)[2], 0);
  EXPECT_GT(read.at<cv::Vec3f>(1, 1)[1], 0);
}

TEST_F(RadiancePictureTest, WrongInputIsRefused) {
  const auto rgb = Picture(2, 9);
  EXPECT_THROW(WriteRadiancePicture(folder_.Path("a.hdr"), {rgb[0], rgb[1], ImagePlane()}, {}),
               std::invalid_argument);
  EXPECT_THROW(WriteRadiancePicture(folder_.Path("a.hdr"), rgb, {"a\n\nb"}), std::invalid_argument);
  folder_.Write("file", "");
  try {
    WriteRadiancePicture(folder_.Path("file/a.hdr"), rgb, {});
    FAIL() << "expected an error";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("file/a.hdr: expected a writable place"));
  }
}

TEST(RadianceBrightnessTest, WhiteIsOne) {
  const ImagePlane white = ImagePlane::Constant(2, 2, 1);
  EXPECT_NEAR(RadianceBrightness({white, white, white})(1, 1), 1, 1e-6);
}

}  // namespace
}  // namespace luxfit
