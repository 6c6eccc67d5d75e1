#include "calib/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace luxfit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ImageTest : public testing::Test {
 protected:
  std::string Path(const std::string& extension) {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    paths_.push_back(testing::TempDir() + "luxfit_image_" + name + extension);
    return paths_.back();
  }
  void TearDown() override {
    for (const std::string& path : paths_) std::remove(path.c_str());
  }

 private:
  std::vector<std::string> paths_;
};

std::string MessageOf(const std::string& path) {
  try {
    ReadPhoto(path);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST_F(ImageTest, SixteenBitColourKeepsEveryCountAndComesInRgbOrder) {
  cv::Mat bgr(2, 3, CV_16UC3, cv::Scalar(1, 2, 3));
  bgr.at<cv::Vec3w>(1, 2) = cv::Vec3w(65535, 12345, 16);
  const std::string path = Path(".png");
  cv::imwrite(path, bgr);
  const Photo photo = ReadPhoto(path);
  EXPECT_EQ(photo.width_px(), 3);
  EXPECT_EQ(photo.height_px(), 2);
  EXPECT_EQ(photo.bits_per_channel, 16);
  EXPECT_EQ(photo.full_scale_counts, 65535);
  EXPECT_EQ(photo.saturation_counts, 65535);
  EXPECT_EQ(photo.rgb_counts[0](1, 2), 16.0f);
  EXPECT_EQ(photo.rgb_counts[1](1, 2), 12345.0f);
  EXPECT_EQ(photo.rgb_counts[2](1, 2), 65535.0f);
  EXPECT_EQ(photo.rgb_counts[0](0, 0), 3.0f);
}

TEST_F(ImageTest, EightBitMonochromeGivesThreeEqualPlanes) {
  cv::Mat grey(2, 2, CV_8UC1, cv::Scalar(7));
  grey.at<uchar>(0, 1) = 255;
  const std::string path = Path(".png");
  cv::imwrite(path, grey);
  const Photo photo = ReadPhoto(path);
  EXPECT_EQ(photo.bits_per_channel, 8);
  EXPECT_EQ(photo.full_scale_counts, 255);
  for (const ImagePlane& plane : photo.rgb_counts) {
    EXPECT_EQ(plane(0, 1), 255.0f);
    EXPECT_EQ(plane(1, 0), 7.0f);
  }
}

TEST_F(ImageTest, AlphaIsIgnored) {
  cv::Mat bgra(1, 1, CV_8UC4, cv::Scalar(10, 20, 30, 40));
  const std::string path = Path(".png");
  cv::imwrite(path, bgra);
  const Photo photo = ReadPhoto(path);
  EXPECT_EQ(photo.rgb_counts[0](0, 0), 30.0f);
  EXPECT_EQ(photo.rgb_counts[2](0, 0), 10.0f);
}

TEST_F(ImageTest, FloatFilesKeepTheirScale) {
  cv::Mat bgr(1, 2, CV_32FC3, cv::Scalar(0.25, 0.5, 0.75));
  bgr.at<cv::Vec3f>(0, 1) = cv::Vec3f(1e-3f, 1234.5f, 2.0f);
  const std::string path = Path(".pfm");
  cv::imwrite(path, bgr);
  const Photo photo = ReadPhoto(path);
  EXPECT_EQ(photo.bits_per_channel, 32);
  // Not the largest count: photos of one session must share a scale.
  EXPECT_EQ(photo.full_scale_counts, 1.0);
  EXPECT_FLOAT_EQ(static_cast<float>(photo.saturation_counts), 1234.5f);
  EXPECT_FLOAT_EQ(photo.rgb_counts[0](0, 0), 0.75f);
  EXPECT_FLOAT_EQ(photo.rgb_counts[2](0, 1), 1e-3f);
}

TEST_F(ImageTest, MissingAndBrokenFilesAreNamed) {
  EXPECT_THAT(MessageOf("no/such.png"),
              StartsWith("no/such.png: cannot read the photo, expected an existing file"));
  const std::string path = Path(".png");
  std::ofstream(path) << "not a picture";
  EXPECT_THAT(MessageOf(path), StartsWith(path + ": cannot read the photo, expected PNG or TIFF"));
  EXPECT_THAT(MessageOf(path), HasSubstr("16 bit"));
}

}  // namespace
}  // namespace luxfit
