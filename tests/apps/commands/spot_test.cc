// luxfit spot on a photo of the office, against its counts as OpenCV reads them and the renderer's own scale.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/support/apps/office_copy.h"
#include "tests/support/apps/program.h"
#include "tests/support/office_truth.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Spot : public testing::Test {
 protected:
  Spot() {
    office_.Write("office/photos.csv",
                  "file,camera,view,state,exposure_s\nphotos/v00_all.png,cam0,v00,all,0.0848\n"
                  "photos/v01_A.png,cam0,v01,A,0.115\n");
    office_.GiveCameraScale();
  }

  support::ProgramRun Run(const std::string& arguments) const { return office_.Run("spot", arguments); }
  json Artifact() const { return office_.Json("out/luminance/spots.json"); }

  support::OfficeCopy office_;
  const double per_cdm2_s_ = support::OfficeTruth().at("cameras").at("cam0").at("counts_per_cdm2_s");
};

TEST_F(Spot, IsTheMeanOfItsCountsByTheScale) {
  const support::ProgramRun run = Run("v00_all:400,300 v01_A:100,100 --radius 2 --scale-sigma-percent 3");
  ASSERT_EQ(run.status, 0) << run.output;
  const json spots = Artifact().at("spots");
  ASSERT_EQ(spots.size(), 2u);
  const double exposures_s[] = {0.0848, 0.115};
  for (size_t i = 0; i < 2; ++i) {
    const json& spot = spots[i];
    const int x = spot.at("x_px"), y = spot.at("y_px");
    const cv::Mat photo = cv::imread(
        office_.Path(i == 0 ? "office/photos/v00_all.png" : "office/photos/v01_A.png"), cv::IMREAD_UNCHANGED);
    double sum = 0;
    int pixels = 0;
    for (int dv = -2; dv <= 2; ++dv) {
      for (int du = -2; du <= 2; ++du) {
        if (du * du + dv * dv > 4) continue;
        const cv::Vec3w bgr = photo.at<cv::Vec3w>(y + dv, x + du);
        sum += (0.265 * bgr[2] + 0.670 * bgr[1] + 0.065 * bgr[0]) / 65535.0;
        ++pixels;
      }
    }
    const double luminance = sum / pixels / exposures_s[i] / per_cdm2_s_;
    EXPECT_EQ(spot.at("pixels"), pixels);
    EXPECT_NEAR(spot.at("luminance_cd_m2"), luminance, 1e-4 * luminance);
    const double noise = spot.at("relative_sigma").at("noise");
    EXPECT_GT(noise, 0);
    EXPECT_NEAR(spot.at("sigma_cd_m2"), luminance * std::hypot(noise, 0.03), 1e-4 * luminance);
  }
  EXPECT_THAT(run.output, HasSubstr("spread %"));
  EXPECT_THAT(office_.Read("out/luminance/spots.csv"), HasSubstr("\nv00_all,v00,all,cam0,400,300,2,13,"));
}

TEST_F(Spot, ATableOfSpotsIsRead) {
  office_.Write("spots.csv", "photo,x_px,y_px,radius_px\nv00_all,400,300,3\nv01_A,100.5,100,1\n");
  const support::ProgramRun run = Run(office_.Path("spots.csv"));
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_EQ(Artifact().at("spots").at(0).at("pixels"), 29);
  EXPECT_EQ(Artifact().at("spots").at(1).at("pixels"), 2);
  EXPECT_THAT(run.output, HasSubstr("leave out the error of the camera's scale"));
}

// As a phone named it: the same photo as v00_all.
TEST_F(Spot, APhotoIsKnownByItsFile) {
  std::filesystem::copy_file(office_.Path("office/photos/v00_all.png"),
                             office_.Path("office/photos/IMG_1238.png"));
  office_.Write("office/photos.csv",
                "file,camera,view,state,exposure_s\nphotos/IMG_1238.png,cam0,v00,all,0.0848\n"
                "photos/v01_A.png,cam0,v01,A,0.115\n");
  const support::ProgramRun run = Run("v00_all:400,300 IMG_1238:400,300 IMG_1238.png:400,300 " +
                                      office_.Path("office/photos/IMG_1238.png") + ":400,300");
  ASSERT_EQ(run.status, 0) << run.output;
  const json spots = Artifact().at("spots");
  ASSERT_EQ(spots.size(), 4u);
  for (const json& spot : spots) EXPECT_EQ(spot, spots[0]);
  EXPECT_THAT(Run("IMG_1239:400,300").output, HasSubstr("expected v00_all or v01_A"));
}

// A luminaire shines there.
TEST_F(Spot, SaturatedPixelsHaveNoLuminance) {
  const cv::Mat photo = cv::imread(office_.Path("office/photos/v00_all.png"), cv::IMREAD_UNCHANGED);
  int x = 0, y = 0;
  for (int v = 20; v + 20 < photo.rows; ++v) {
    for (int u = 20; u + 20 < photo.cols; ++u) {
      if (photo.at<cv::Vec3w>(v, u)[1] > 0.97 * 65535) x = u, y = v;
    }
  }
  ASSERT_GT(x, 0);
  const support::ProgramRun run =
      Run("v00_all:" + std::to_string(x) + "," + std::to_string(y) + " v01_A:100,100");
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output, HasSubstr("saturated: above"));
  EXPECT_THAT(run.output, HasSubstr("1 of 2 spots have pixels that are saturated in every exposure"));
  const json spot = Artifact().at("spots").at(0);
  EXPECT_EQ(spot.at("gap"), "saturated");
  EXPECT_TRUE(spot.at("luminance_cd_m2").is_null());
  EXPECT_GT(spot.at("at_least_cd_m2").get<double>(), 0);
  EXPECT_FALSE(Artifact().at("spots").at(1).at("luminance_cd_m2").is_null());
}

TEST_F(Spot, DarkPixelsHaveNoLuminance) {
  cv::imwrite(office_.Path("office/photos/v01_A.png"), cv::Mat(360, 480, CV_16UC3, cv::Scalar(3, 3, 3)));
  const support::ProgramRun run = Run("v01_A:100,100");
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output, HasSubstr("too dark"));
  EXPECT_EQ(Artifact().at("warnings").at(0).at("code"), "luminance_dark");
}

TEST_F(Spot, WithoutAScaleThereAreNoCandelas) {
  const std::string session = office_.Read("office/session.toml");
  const size_t at = session.find("cdm2_per_count_s");
  office_.Write("office/session.toml", session.substr(0, at) + session.substr(session.find('\n', at)));
  const support::ProgramRun run = Run("v01_A:100,100");
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output, HasSubstr("relative units"));
  EXPECT_THAT(run.output, HasSubstr("cdm2_per_count_s"));
  const json spot = Artifact().at("spots").at(0);
  EXPECT_TRUE(spot.at("luminance_cd_m2").is_null());
  EXPECT_GT(spot.at("relative_luminance").get<double>(), 0);
}

TEST_F(Spot, BadInputIsNamed) {
  const auto expect = [&](const std::string& arguments, const std::string& message) {
    const support::ProgramRun run = Run(arguments);
    EXPECT_EQ(run.status, 2) << arguments << "\n" << run.output;
    EXPECT_THAT(run.output, HasSubstr(message)) << arguments;
  };
  expect("v00_all", "SPOT: expected PHOTO:X,Y");
  expect("'v00_all:1;2'", "SPOT: expected PHOTO:X,Y");
  expect("v00_all:1,2x", "SPOT: expected PHOTO:X,Y");
  expect("v00_al:100,100",
         "SPOT v00_al:100,100: expected v00_all or v01_A, got \"v00_al\"; did you mean \"v00_all\"?");
  expect("v00_all:2,100", "SPOT v00_all:2,100: expected a circle within the photo of 480 x 360 pixels");
  expect("v00_all:100,359",
         "expected a circle within the photo of 480 x 360 pixels, got 5 px about (100, 359)");
  expect("v00_all:100,100 --radius 0.5", "--radius");
  expect(office_.Path("none.csv"), "none.csv");
  office_.Write("spots.csv", "photo,x_px,y_px,radius_px\nv00_all,400,300,3\nv00_all,400,300,0\n");
  expect(office_.Path("spots.csv"), "spots.csv:3: radius_px: expected 1 or more, got 0");
  office_.Write("spots.csv", "photo,x_px,y_px\nv00_all,400,300\nv09_A,400,300\n");
  expect(office_.Path("spots.csv"), "spots.csv:3: expected v00_all or v01_A, got \"v09_A\"");
}

TEST_F(Spot, ASessionNeedsAFolderForItsResults) {
  const support::ProgramRun run =
      support::RunProgram("spot " + office_.Path("office/session.toml") + " v00_all:100,100");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("-o: expected the folder for the results of a session"));
}

TEST_F(Spot, AFolderThatIsNoRunIsRefused) {
  const support::ProgramRun run = support::RunProgram("spot " + office_.Path("office") + " v00_all:100,100");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("result.json"));
}

}  // namespace
}  // namespace luxfit
