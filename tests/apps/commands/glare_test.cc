// luxfit glare on made photos of a fisheye and a pinhole, whose counts are cd/m2: a disc on the axis, where p = 1.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double kPi = 3.14159265358979323846;
constexpr int kSide = 401, kMiddle = 200;

class GlareOfPhotos : public testing::Test {
 protected:
  GlareOfPhotos() { WriteSession(); }

  // 200 px a right angle, equidistant; or a pinhole of 400 px.
  void WriteSession(const std::string& scale = "cdm2_per_count_s = 1\n", bool is_fisheye = true) const {
    const std::string focal = is_fisheye ? "127.32395447351628" : "400.";
    folder_.Write(
        "cam0.yaml",
        "%YAML:1.0\n---\nimage_width: 401\nimage_height: 401\ncamera_matrix: !!opencv-matrix\n   rows: 3\n"
        "   cols: 3\n   dt: d\n   data: [ " +
            focal + ", 0., 200., 0., " + focal + ", 200., 0., 0., 1. ]\n" +
            (is_fisheye ? "distortion_model: equidistant\n" : "") +
            "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 4\n   dt: d\n"
            "   data: [ 0., 0., 0., 0. ]\n");
    folder_.Write(
        "session.toml",
        "name = \"disc\"\n[[camera]]\nid = \"cam0\"\nintrinsics = \"cam0.yaml\"\nresponse = \"linear\"\n" +
            scale + "[photos]\ntable = \"photos.csv\"\n[states]\nday = { A = 1.0 }\nnight = { A = 0.1 }\n");
    folder_.Write("photos.csv",
                  "file,camera,view,state,exposure_s\nday.png,cam0,v0,day,1\nnight.png,cam0,v0,night,1\n");
    WriteDisc("day.png", 20000, is_fisheye);
    WriteDisc("night.png", 1000, is_fisheye);
  }

  // A disc of 0.2 rad about the axis, before 200 cd/m2.
  void WriteDisc(const std::string& file, int luminance_cd_m2, bool is_fisheye = true) const {
    cv::Mat photo(kSide, kSide, CV_16UC3, cv::Scalar(200, 200, 200));
    const double radius_px = is_fisheye ? 0.2 * 400 / kPi : 400 * std::tan(0.2);
    for (int v = 0; v < kSide; ++v) {
      for (int u = 0; u < kSide; ++u) {
        if (std::hypot(u - kMiddle, v - kMiddle) < radius_px)
          photo.at<cv::Vec3w>(v, u) = cv::Vec3w::all(static_cast<uint16_t>(luminance_cd_m2));
      }
    }
    cv::imwrite(folder_.Path(file), photo);
  }

  support::ProgramRun Run(const std::string& arguments) const {
    return support::RunProgram("glare " + folder_.Path("session.toml") + " " + arguments + " -o " +
                               folder_.Path("out"));
  }
  json Rating(size_t photo) const {
    return json::parse(folder_.Read("out/luminance/glare.json")).at("photos").at(photo).at("rating");
  }

  TempFolder folder_;
};

TEST_F(GlareOfPhotos, AHemisphereTellsAll) {
  const support::ProgramRun run = Run("--scale-sigma-percent 2");
  ASSERT_EQ(run.status, 0) << run.output;
  const double omega = 2 * kPi * (1 - std::cos(0.2)), source_lx = kPi * 20000 * std::pow(std::sin(0.2), 2);
  const double left = 200 * std::pow(std::cos(0.2), 2), vertical_lx = source_lx + kPi * left,
               sum = 4e8 * omega;
  const json day = Rating(0);
  EXPECT_NEAR(day.at("field_share"), 1, 1e-3);
  EXPECT_NEAR(day.at("vertical_lx"), vertical_lx, 0.01 * vertical_lx);
  EXPECT_NEAR(day.at("vertical_sigma_lx"), 0.02 * vertical_lx, 0.01 * 0.02 * vertical_lx);
  EXPECT_NEAR(day.at("background_cd_m2"), left, 1);
  EXPECT_NEAR(day.at("ugr"), 8 * std::log10(0.25 / left * sum), 0.05);
  EXPECT_NEAR(day.at("ugr_sigma"), 8 * std::log10(1.02), 1e-6);
  EXPECT_NEAR(day.at("dgp"),
              5.87e-5 * vertical_lx + 0.0918 * std::log10(1 + sum / std::pow(vertical_lx, 1.87)) + 0.16,
              2e-3);
  EXPECT_EQ(day.at("ugr_is"), "value");
  ASSERT_EQ(day.at("sources").size(), 1u);
  EXPECT_NEAR(day.at("sources").at(0).at("x_px"), kMiddle, 1e-3);
  EXPECT_NEAR(day.at("sources").at(0).at("ugr_index"), 1, 1e-3);
  EXPECT_TRUE(Rating(1).at("sources").empty());  // below 2000 cd/m2
  EXPECT_TRUE(Rating(1).at("ugr").is_null());
  EXPECT_THAT(folder_.Read("out/luminance/glare.csv"), HasSubstr("\nv0_day,v0,day,"));
}

TEST_F(GlareOfPhotos, TheThresholdCanBeChosen) {
  ASSERT_EQ(Run("v0_night --threshold 900").status, 0);
  EXPECT_EQ(Rating(0).at("sources").size(), 1u);
  ASSERT_EQ(Run("v0_night --threshold 4.5x").status, 0);
  // By hand: 4.5 (200 + 800 (1 - cos 0.2)).
  EXPECT_NEAR(Rating(0).at("threshold_cd_m2"), 4.5 * (200 + 800 * (1 - std::cos(0.2))), 5);
}

TEST_F(GlareOfPhotos, ASmallerPhotoNeedsALuxmeter) {
  WriteSession("cdm2_per_count_s = 1\n", false);
  const support::ProgramRun seen = Run("v0_day");
  ASSERT_EQ(seen.status, 0) << seen.output;
  EXPECT_THAT(seen.output, HasSubstr("DGP needs --ev"));
  EXPECT_EQ(Rating(0).at("vertical_is"), "at_least");
  EXPECT_EQ(Rating(0).at("ugr_is"), "of_what_is_seen");
  EXPECT_TRUE(Rating(0).at("dgp").is_null());
  const support::ProgramRun given = Run("v0_day --ev 4000");
  ASSERT_EQ(given.status, 0) << given.output;
  EXPECT_EQ(Rating(0).at("vertical_is"), "given");
  EXPECT_EQ(Rating(0).at("ugr_is"), "at_least");
  const double sum = 4e8 * 2 * kPi * (1 - std::cos(0.2));
  EXPECT_NEAR(Rating(0).at("dgp"),
              5.87e-5 * 4000 + 0.0918 * std::log10(1 + sum / std::pow(4000, 1.87)) + 0.16, 2e-3);
}

TEST_F(GlareOfPhotos, ClippedPixelsAreABound) {
  WriteDisc("day.png", 65535);
  const support::ProgramRun run = Run("v0_day");
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output,
              HasSubstr("glare is at least the one stated; in 0 they saturate below the threshold"));
  EXPECT_EQ(Rating(0).at("ugr_is"), "at_least");
  EXPECT_EQ(Rating(0).at("vertical_is"), "at_least");
  // The same counts at a scale of 0.01 clip at 655 cd/m2.
  WriteSession("cdm2_per_count_s = 0.01\n");
  WriteDisc("day.png", 65535);
  const support::ProgramRun hidden = Run("v0_day");
  EXPECT_EQ(hidden.status, 1) << hidden.output;
  EXPECT_THAT(hidden.output, HasSubstr("in 1 they saturate below the threshold"));
  EXPECT_TRUE(Rating(0).at("is_hidden").get<bool>());
  EXPECT_TRUE(Rating(0).at("ugr").is_null());
}

TEST_F(GlareOfPhotos, WithoutAScaleThereIsNoRating) {
  WriteSession("");
  const support::ProgramRun run = Run("");
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output, HasSubstr("2 of 2 photos have no glare rating"));
  EXPECT_TRUE(Rating(0).is_null());
}

TEST_F(GlareOfPhotos, BadInputIsNamed) {
  const auto expect = [&](const std::string& arguments, const std::string& message) {
    const support::ProgramRun run = Run(arguments);
    EXPECT_EQ(run.status, 2) << arguments << "\n" << run.output;
    EXPECT_THAT(run.output, HasSubstr(message)) << arguments;
  };
  expect("v0_da", "PHOTO v0_da: expected v0_day or v0_night, got \"v0_da\"; did you mean \"v0_day\"?");
  expect("--ev 400", "--ev: expected one photo, whose lens the luxmeter stood at, got 2");
  expect("v0_day --ev 400", "--ev: expected at least the 3");
  expect("v0_day --ev 0", "--ev");
  expect("v0_day --threshold 5y", "--threshold: expected cd/m2 above 0");
  expect("v0_day --threshold -3", "--threshold");
  folder_.Replace("session.toml", "intrinsics = \"cam0.yaml\"\n", "");
  expect("v0_day", "camera[0].intrinsics: expected");
}

}  // namespace
}  // namespace luxfit
