// The program on corners of known truth: what it writes, what it says, and its exit status.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "calib/lens/camera_file.h"
#include "calib/targets/board.h"
#include "tests/support/apps/program.h"
#include "tests/support/calib/board_views.h"
#include "tests/support/temp_folder.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::string CornersOf(const CalibrationInput& input, int camera) {
  std::vector<ImageCorners> images;
  for (const CalibrationImage& image : input.images) {
    if (image.camera == camera) images.push_back({image.name + ".png", image.corners});
  }
  return CornersFile(images, static_cast<int>(input.target.points.size()));
}

std::string CameraToml(const std::string& id) {
  return "[[camera]]\nid = \"" + id + "\"\ncalibration_corners = \"" + id +
         ".vnl\"\nimage_size = [1280, 960]\n" +
         "board = { type = \"chessboard\", columns = 12, rows = 9, square_size_m = 0.05 }\n";
}

std::string ChosenFor(const std::string& what, const json& artifact) {
  for (const json& choice : artifact["choices"]) {
    if (choice["what"] == what) return choice["chosen"];
  }
  return "no such choice";
}

class CalibrateTest : public testing::Test {
 protected:
  support::ProgramRun Calibrate(const std::string& flags = "") {
    return support::RunProgram("calibrate " + folder_.Path("session.toml") + " -o " + folder_.Path("out") +
                               flags);
  }
  TempFolder folder_;
};

TEST_F(CalibrateTest, ARigIsWrittenInEveryFormatThatHoldsIt) {
  auto rng = support::TestRng();
  support::BoardViewsOptions views;
  views.images = 14;
  Eigen::Isometry3d second = Eigen::Isometry3d::Identity();
  second.translation().x() = -0.1;
  Camera truth = support::OpenCv8Camera();
  truth.distortion = {-0.2, 0.06, 1e-3, -5e-4};
  const support::BoardViews rig(support::GridTarget(), {truth, truth},
                                {Eigen::Isometry3d::Identity(), second}, views, rng);
  folder_.Write("cam0.vnl", CornersOf(rig.input(), 0));
  folder_.Write("cam1.vnl", CornersOf(rig.input(), 1));
  folder_.Write("session.toml",
                CameraToml("cam0") + CameraToml("cam1") + "[calibration]\nlens = \"opencv4\"\n");
  const support::ProgramRun run = Calibrate(" --json 2>/dev/null");
  ASSERT_EQ(run.status, 0) << run.output;
  const json artifact = json::parse(run.output.substr(run.output.find('{')));
  EXPECT_EQ(artifact["format"], "luxfit-calibrate-1");
  EXPECT_EQ(artifact["status"], "done");
  ASSERT_EQ(artifact["groups"].size(), 1U);
  const json& group = artifact["groups"][0];
  EXPECT_TRUE(group["is_rig"]);
  EXPECT_EQ(group["lens"], "OPENCV4") << "scripts compare it";
  EXPECT_EQ(ChosenFor("lens of cam0, cam1", artifact), "opencv4") << "as sessions spell it";
  EXPECT_EQ(ChosenFor("photos of cam1", artifact), "14");
  EXPECT_EQ(ChosenFor("sets of cam0, cam1", artifact), "14, by numbers");
  const json& second_camera = group["cameras"][1];
  EXPECT_NEAR(second_camera["position_in_rig_m"][0], 0.1, 1e-3);
  EXPECT_NEAR(second_camera["baseline_m"], 0.1, 4 * second_camera["baseline_sigma_m"].get<double>());
  EXPECT_NEAR(second_camera["rotation_deg"], 0, 4 * second_camera["rotation_sigma_deg"].get<double>());
  EXPECT_EQ(group["cameras"][0]["baseline_m"], 0);
  EXPECT_EQ(group["images"].size(), 28U);
  EXPECT_EQ(group["board"], "chessboard:12x9:0.05");
  const json maps = second_camera["uncertainty"]["maps"];
  ASSERT_EQ(maps.size(), 2U);
  EXPECT_TRUE(maps[0]["range_m"].is_null()) << "directions";
  EXPECT_NEAR(maps[1]["range_m"], group["images"][0]["distance_m"], 1);
  EXPECT_EQ(maps[0]["sigma_px"].size(), 18U) << "24 columns of an image of 4 : 3";
  EXPECT_NEAR(maps[0]["sigma_px"][9][12], second_camera["uncertainty"]["middle_px"], 0.01);
  for (const char* name : {"cam0.yaml", "cam1.cameramodel", "camchain.yaml", "cameras.txt"}) {
    const std::vector<FiledCamera> read = ReadCameraFile(folder_.Path("out/" + std::string(name)));
    EXPECT_NEAR(read.back().camera.fx_px, truth.fx_px, 2) << name;
  }
  EXPECT_EQ(folder_.Read("out/cam0_uncertainty.svg").rfind("<svg", 0), 0U);
  EXPECT_NE(folder_.Read("out/corner_residuals.csv").find("\"cam1_3.png\",\"cam1\","), std::string::npos);
  EXPECT_EQ(folder_.Read("out/corner_residuals.csv")
                .rfind("file,camera,corner,residual_x_px,residual_y_px,outlier,x_px,y_px\n", 0),
            0U);
  EXPECT_EQ(ReadCornersFile(folder_.Path("out/corners.vnl"), 108).size(), 28U);
  EXPECT_FALSE(folder_.Read("out/stages/calibrate.json").empty());
}

// A corner's pixel and residual follow from the artifact alone: pose of the target, lens, place on the board.
TEST_F(CalibrateTest, PosesOfTheTargetPlaceItsCorners) {
  auto rng = support::TestRng();
  support::BoardViewsOptions views;
  views.images = 10;
  const CalibrationInput input = support::ViewsOf(support::OpenCv8Camera(), views, rng);
  folder_.Write("cam0.vnl", CornersOf(input, 0));
  folder_.Write("session.toml", CameraToml("cam0") + "[calibration]\nlens = \"opencv8\"\n");
  Calibrate();
  const json group = json::parse(folder_.Read("out/stages/calibrate.json"))["groups"][0];
  const Camera camera = ReadCameraFile(folder_.Path("out/cam0.cameramodel")).front().camera;
  for (std::size_t i = 0; i < group["images"].size(); ++i) {
    const json& image = group["images"][i];
    Eigen::Vector3d p_in_cam;
    const BoardCorner& corner = input.images[i].corners.front();
    for (int k = 0; k < 3; ++k) {
      p_in_cam[k] = image["t_camera_from_target_m"][k];
      for (int m = 0; m < 3; ++m)
        p_in_cam[k] += image["R_camera_from_target"][k][m].get<double>() *
                       input.target.points[static_cast<std::size_t>(corner.index)][m];
    }
    EXPECT_LT((Project(camera, p_in_cam) - corner.pixel).norm(), 8 * group["noise_px"].get<double>()) << i;
  }
}

TEST_F(CalibrateTest, WhatFailsAGateIsMarkedAndEndsWithOne) {
  auto rng = support::TestRng();
  support::BoardViewsOptions views;
  views.images = 10;
  views.tilt_deg = 2;
  folder_.Write("cam0.vnl", CornersOf(support::ViewsOf(support::OpenCv8Camera(), views, rng), 0));
  folder_.Write("session.toml", CameraToml("cam0") + "[calibration]\nlens = \"opencv4\"\n");
  const support::ProgramRun run = Calibrate();
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output, HasSubstr("10 images, opencv4: "));
  EXPECT_THAT(run.output, HasSubstr("NOT USABLE"));
  EXPECT_THAT(run.output, HasSubstr("never tilted"));
  EXPECT_THAT(folder_.Read("out/cam0.yaml"), HasSubstr("# NOT USABLE as it is:"));
  EXPECT_NO_THROW(ReadCameraFile(folder_.Path("out/cam0.yaml"))) << "marked, but still the format";
  EXPECT_NO_THROW(ReadCameraFile(folder_.Path("out/cam0.cameramodel")));
  EXPECT_NO_THROW(ReadCameraFile(folder_.Path("out/cameras.txt")));
  const json artifact = json::parse(folder_.Read("out/stages/calibrate.json"));
  EXPECT_EQ(artifact["status"], "undetermined");
  EXPECT_THAT(artifact["status_because"].get<std::vector<std::string>>(), testing::Contains("coverage"));
  EXPECT_THAT(run.output, HasSubstr("undetermined because of "));
  EXPECT_THAT(run.output, HasSubstr("undetermined: cam0: "));
}

TEST_F(CalibrateTest, ARigThatMovedIsWarnedOf) {
  auto rng = support::TestRng();
  support::BoardViewsOptions views;
  views.images = 12;
  Eigen::Isometry3d second = Eigen::Isometry3d::Identity();
  second.translation().x() = -0.1;
  CalibrationInput input =
      support::BoardViews(support::GridTarget(), {support::OpenCv8Camera(), support::OpenCv8Camera()},
                          {Eigen::Isometry3d::Identity(), second}, views, rng)
          .input();
  // As if the second camera had turned by a milliradian between sets.
  for (CalibrationImage& image : input.images) {
    for (BoardCorner& corner : image.corners) {
      if (image.camera == 1) corner.pixel.x() += image.set % 2 == 0 ? 1 : -1;
    }
  }
  folder_.Write("cam0.vnl", CornersOf(input, 0));
  folder_.Write("cam1.vnl", CornersOf(input, 1));
  folder_.Write("session.toml",
                CameraToml("cam0") + CameraToml("cam1") + "[calibration]\nlens = \"opencv5\"\n");
  const support::ProgramRun run = Calibrate();
  EXPECT_THAT(run.output, HasSubstr("warning: cam0, cam1: as a rig they miss the corners by "));
  EXPECT_THAT(run.output,
              HasSubstr("sets of cam0, cam1: 12, by numbers, cam0_0.png with cam1_0.png and so on"));
}

TEST_F(CalibrateTest, CamerasThatAreNoRigAreCalibratedAlone) {
  auto rng = support::TestRng();
  support::BoardViewsOptions views;
  views.images = 12;
  folder_.Write("cam0.vnl", CornersOf(support::ViewsOf(support::OpenCv8Camera(), views, rng), 0));
  folder_.Write("cam1.vnl", CornersOf(support::ViewsOf(support::OpenCv8Camera(), views, rng), 0));
  folder_.Write("session.toml",
                CameraToml("cam0") + CameraToml("cam1") + "[calibration]\nlens = \"opencv5\"\n");
  const support::ProgramRun run = Calibrate();
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("do not fit cameras fixed to each other"));
  EXPECT_EQ(json::parse(folder_.Read("out/stages/calibrate.json"))["groups"].size(), 2U);
}

TEST_F(CalibrateTest, InputErrorsNameTheirFile) {
  folder_.Write("cam0.vnl", "# filename x y level\na.png 1 2 0\n");
  folder_.Write("session.toml", CameraToml("cam0"));
  EXPECT_EQ(Calibrate().status, 2);
  EXPECT_THAT(Calibrate().output, HasSubstr("cam0.vnl:2: corners: expected 108 rows for a.png"));
  folder_.Write("session.toml", "name = \"none\"\n");
  EXPECT_THAT(Calibrate().output, HasSubstr("expected a camera with calibration_images"));
}

}  // namespace
}  // namespace luxfit
