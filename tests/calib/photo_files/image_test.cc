#include "calib/photo_files/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
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

// A picture of one colour in Radiance's flat form, with the header's lines as given.
void WriteRadiance(const std::string& path, const std::string& lines, const std::array<int, 4>& rgbe) {
  std::ofstream file(path, std::ios::binary);
  file << "#?RADIANCE\n" << lines << "\n-Y 2 +X 3\n";
  for (int i = 0; i < 6; ++i) {
    for (const int byte : rgbe) file.put(static_cast<char>(byte));
  }
}

TEST_F(ImageTest, RadiancePicturesAreDividedByTheExposureTheyState) {
  const std::string path = Path(".hdr");
  // 128, 64, 32 with exponent 129 (2^1 / 256): 1, 0.5, 0.25.
  WriteRadiance(path, "EXPOSURE=4\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=0.5\nCOLORCORR=1 2 1\n",
                {128, 64, 32, 129});
  const Photo photo = ReadPhoto(path);
  ASSERT_EQ(photo.width_px(), 3);
  EXPECT_EQ(photo.full_scale_counts, 1.0);
  // A mantissa stands for the middle of its step in some readers.
  EXPECT_NEAR(photo.rgb_counts[0](1, 2), 1.0 / 2, 0.5 / 256);
  EXPECT_NEAR(photo.rgb_counts[1](1, 2), 0.5 / 4, 0.5 / 512);
  EXPECT_NEAR(photo.rgb_counts[2](1, 2), 0.25 / 2, 0.5 / 256);
  EXPECT_NEAR(photo.saturation_counts, 0.5, 0.5 / 256);
}

TEST_F(ImageTest, RadiancePicturesThatAreNoCamerasAreRefused) {
  const std::string path = Path(".hdr");
  WriteRadiance(path, "FORMAT=32-bit_rle_xyze\n", {128, 64, 32, 129});
  EXPECT_THAT(MessageOf(path), HasSubstr("CIE XYZ"));
  WriteRadiance(path, "FORMAT=32-bit_rle_rgbe\nEXPOSURE=0\n", {128, 64, 32, 129});
  EXPECT_THAT(MessageOf(path), HasSubstr("EXPOSURE=0"));
}

TEST_F(ImageTest, FloatTiffIsExactAndLogLuvIsRefused) {
  const cv::Mat bgr(4, 4, CV_32FC3, cv::Scalar(0.25, 0.5, 1234.5));
  const std::string path = Path(".tiff");
  cv::imwrite(path, bgr, {cv::IMWRITE_TIFF_COMPRESSION, 1});
  EXPECT_EQ(ReadPhoto(path).rgb_counts[0](3, 3), 1234.5f);
  cv::imwrite(path, bgr);  // OpenCV's own choice
  EXPECT_THAT(MessageOf(path), HasSubstr("LogLuv"));
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
