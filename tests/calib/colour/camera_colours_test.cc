#include "calib/colour/camera_colours.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/calib/test_dng.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

constexpr int kWidth = 40, kHeight = 32;

std::string WriteDng(const TempFolder& folder, const std::array<int, 9>& matrix_1e4) {
  support::TestDng dng;
  dng.width_px = kWidth;
  dng.height_px = kHeight;
  dng.counts.assign(size_t{kWidth} * kHeight, 1000);
  dng.color_matrix_1e4 = matrix_1e4;
  support::WriteTestDng(folder.Path("a.dng"), dng);
  return folder.Path("a.dng");
}

// ColorMatrix takes XYZ to the sensor's counts.
TEST(CameraColours, ADngsMatrixIsInverted) {
  const TempFolder folder;
  const auto found =
      ReadSensorColours(WriteDng(folder, {7034, -804, -1014, -4420, 12564, 2058, -851, 1994, 5758}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->source, kSensorColours);
  Eigen::Matrix3d stated;
  stated << 0.7034, -0.0804, -0.1014, -0.4420, 1.2564, 0.2058, -0.0851, 0.1994, 0.5758;
  // Equal up to one factor, which means nothing.
  const Eigen::Matrix3d product = stated * found->xyz_from_rgb;
  EXPECT_LT((product / product(0, 0) - Eigen::Matrix3d::Identity()).norm(), 1e-5) << product;
  EXPECT_NEAR(LuminanceWeightsOf(found->xyz_from_rgb).sum(), 1, 1e-12);
}

TEST(CameraColours, PhotosThatAreNotRawHaveNoSensorsMatrix) {
  const TempFolder folder;
  cv::imwrite(folder.Path("a.png"), cv::Mat(kHeight, kWidth, CV_16UC3, cv::Scalar(1, 2, 3)));
  EXPECT_FALSE(ReadSensorColours(folder.Path("a.png")));
  EXPECT_FALSE(ReadSensorColours("/nowhere.dng"));
  const CameraColours srgb = ReadDisplayColours(folder.Path("a.png"));
  EXPECT_EQ(srgb.source, "sRGB");
  EXPECT_NEAR((LuminanceWeightsOf(srgb.xyz_from_rgb) - Eigen::Vector3d(0.2126, 0.7152, 0.0722)).norm(), 0,
              1e-4);
}

}  // namespace
}  // namespace luxfit
