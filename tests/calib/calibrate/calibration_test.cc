#include "calib/calibrate/calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/support/calib/board_views.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::BoardViews;
using support::BoardViewsOptions;
using support::FisheyeCamera;
using support::GridTarget;
using support::OpenCv8Camera;
using support::TestRng;
using support::ViewsOf;
using testing::HasSubstr;

constexpr double kNoisePx = 0.3;

CalibrateCamerasOptions Only(const std::string& lens) {
  CalibrateCamerasOptions options;
  options.lenses = {*LensKindOf(lens)};
  return options;
}

BoardViewsOptions Views(int images) {
  BoardViewsOptions options;
  options.images = images;
  return options;
}

BoardViewsOptions WideViews(int images) {
  BoardViewsOptions options = Views(images);
  options.nearest_m = 0.15;
  options.farthest_m = 0.45;
  return options;
}

const CalibrationNote* NoteOf(const Calibration& calibration, const std::string& code) {
  for (const CalibrationNote& note : calibration.notes) {
    if (note.code == code) return &note;
  }
  return nullptr;
}

// Returns the sigma of fx, px, which it prints and expects below `most_px`: an error within some sigmas says nothing
// where a sigma may be anything. The limits are 1.5 times what the normal equations of the corners give.
double SigmaFxPx(const CalibratedCamera& camera, double most_px) {
  const double sigma_px = std::sqrt(camera.uncertainty.covariance(0, 0));
  std::printf("sigma of fx %.3f px, expected below %.3f px\n", sigma_px, most_px);
  EXPECT_GT(sigma_px, 0);
  EXPECT_LT(sigma_px, most_px);
  return sigma_px;
}

TEST(Calibration, RecoversALensWithinItsOwnSigma) {
  auto rng = TestRng();
  const Camera truth = OpenCv8Camera();
  const Calibration result = CalibrateCameras(ViewsOf(truth, Views(20), rng), Only("opencv8"));
  ASSERT_TRUE(result.IsUsable()) << result.message;
  const CalibratedCamera& camera = result.cameras.front();
  const double sigma_cy_px = std::sqrt(camera.uncertainty.covariance(3, 3));
  std::printf("sigma of cy %.3f px\n", sigma_cy_px);
  EXPECT_NEAR(camera.camera.fx_px, truth.fx_px, 4 * SigmaFxPx(camera, 0.57));  // 0.38 px
  EXPECT_NEAR(camera.camera.cy_px, truth.cy_px, 4 * sigma_cy_px);
  EXPECT_LT(sigma_cy_px, 0.47);  // 0.31 px
  // 3 600 residuals: their rms is known to 1.2 %.
  EXPECT_NEAR(result.noise_px, kNoisePx, 0.04 * kNoisePx);
  EXPECT_NEAR(result.held_out_px, kNoisePx, 0.06 * kNoisePx);
  EXPECT_NEAR(result.rms_2d_px, std::sqrt(2.0) * result.rms_px, 1e-12);
  EXPECT_LT(result.outlier_share, 3e-3);
  EXPECT_TRUE(result.board_bend_m.isZero()) << "a flat board is no bent one";
}

TEST(Calibration, OpenCvsBackEndFindsTheSameLens) {
  auto rng = TestRng();
  const Camera truth = OpenCv8Camera();
  const CalibrationInput input = ViewsOf(truth, Views(10), rng);
  CalibrateCamerasOptions options = Only("opencv5");
  options.board_may_bend = false;
  const Calibration by_mrcal = CalibrateCameras(input, options);
  options.back_end = CalibrationBackEnd::kOpenCv;
  const Calibration by_opencv = CalibrateCameras(input, options);
  ASSERT_TRUE(by_mrcal.converged && by_opencv.converged);
  // The same least squares but for mrcal's regularisation: far less apart than their uncertainty.
  const double sigma_px = SigmaFxPx(by_mrcal.cameras[0], 0.59);  // 0.39 px
  EXPECT_NEAR(by_opencv.cameras[0].camera.fx_px, by_mrcal.cameras[0].camera.fx_px, 0.1 * sigma_px);
  EXPECT_NEAR(by_opencv.rms_px, by_mrcal.rms_px, 1e-3 * by_mrcal.rms_px);
}

TEST(Calibration, TheSimplestLensThatHeldOutImagesSupportIsTaken) {
  auto rng = TestRng();
  Camera simple = OpenCv8Camera();
  simple.distortion = {-0.2, 0.06, 1e-3, -5e-4};
  const Calibration for_simple = CalibrateCameras(ViewsOf(simple, Views(14), rng));
  EXPECT_EQ(ToString(for_simple.lens), "opencv4");
  ASSERT_GE(for_simple.lenses.size(), 4U);
  const Calibration for_wide = CalibrateCameras(ViewsOf(FisheyeCamera(), WideViews(16), rng));
  EXPECT_EQ(ToString(for_wide.lens), "fisheye");
  for (const LensScore& lens : for_wide.lenses) {
    if (ToString(lens.kind) == "opencv4") {
      EXPECT_GT(lens.held_out_px, 2 * kNoisePx) << "four coefficients cannot bend that far";
    }
  }
  EXPECT_FALSE(for_wide.lens_because.empty());
}

TEST(Calibration, OutliersAreFoundAndQuestioned) {
  auto rng = TestRng();
  const Camera truth = OpenCv8Camera();
  for (const double share : {0.1, 0.4}) {
    BoardViewsOptions views = Views(16);
    views.outlier_share = share;
    const Calibration result = CalibrateCameras(ViewsOf(truth, views, rng), Only("opencv5"));
    ASSERT_TRUE(result.converged) << result.message;
    // 0.34 px from nine tenths of the corners, 0.45 px from six tenths.
    const double sigma_px = SigmaFxPx(result.cameras[0], share < 0.2 ? 0.52 : 0.67);
    EXPECT_NEAR(result.cameras[0].camera.fx_px, truth.fx_px, 4 * sigma_px) << share;
    EXPECT_NEAR(result.outlier_share, share, 0.03);
    const CalibrationNote* const note = NoteOf(result, "outliers");
    ASSERT_NE(note, nullptr);
    EXPECT_EQ(note->fails, share > 0.2);
    EXPECT_THAT(note->message, HasSubstr("most in cam0_"));
  }
}

TEST(Calibration, AFocalLengthWrongByThirtyPercentChangesNothing) {
  auto rng = TestRng();
  const CalibrationInput input = ViewsOf(OpenCv8Camera(), Views(12), rng);
  CalibrateCamerasOptions options = Only("opencv5");
  const double scanned_px = CalibrateCameras(input, options).cameras.at(0).camera.fx_px;
  for (const double wrong : {0.7, 1.3}) {
    options.focal_start_px = wrong * OpenCv8Camera().fx_px;
    EXPECT_NEAR(CalibrateCameras(input, options).cameras.at(0).camera.fx_px, scanned_px, 1e-3) << wrong;
  }
}

TEST(Calibration, BoardsThatAreOnlyFrontalDoNotPass) {
  auto rng = TestRng();
  BoardViewsOptions views = Views(15);
  views.tilt_deg = 3;
  const Calibration result = CalibrateCameras(ViewsOf(OpenCv8Camera(), views, rng), Only("opencv4"));
  EXPECT_FALSE(result.IsUsable());
  const CalibrationNote* const note = NoteOf(result, "coverage");
  ASSERT_NE(note, nullptr);
  EXPECT_THAT(note->message, HasSubstr("never tilted more than"));
  EXPECT_LT(result.rms_px, 1.3 * kNoisePx) << "the residuals alone would have passed";
}

TEST(Calibration, BoardsInTheMiddleOnlyDoNotPass) {
  auto rng = TestRng();
  BoardViewsOptions views = Views(15);
  views.reach = 0.05;
  views.nearest_m = 1.6;
  views.farthest_m = 2.5;
  const Calibration result = CalibrateCameras(ViewsOf(OpenCv8Camera(), views, rng), Only("opencv8"));
  EXPECT_FALSE(result.IsUsable());
  const CalibrationNote* const note = NoteOf(result, "coverage");
  ASSERT_NE(note, nullptr);
  EXPECT_THAT(note->message, HasSubstr("third"));
  EXPECT_NE(NoteOf(result, "uncertain_projection"), nullptr);
}

TEST(Calibration, ABentBoardIsMeasuredAlongWithTheLens) {
  auto rng = TestRng();
  BoardViewsOptions views = Views(16);
  views.bend_m = {0.002, -0.001};
  const Calibration result = CalibrateCameras(ViewsOf(OpenCv8Camera(), views, rng), Only("opencv5"));
  ASSERT_TRUE(result.IsUsable()) << result.message;
  EXPECT_NEAR(result.board_bend_m.x(), 0.002, 4 * result.board_bend_sigma_m.x());
  EXPECT_NEAR(result.board_bend_m.y(), -0.001, 4 * result.board_bend_sigma_m.y());
  std::printf("sigma of the bend %.4f and %.4f mm\n", 1000 * result.board_bend_sigma_m.x(),
              1000 * result.board_bend_sigma_m.y());
  EXPECT_LT(result.board_bend_sigma_m.maxCoeff(), 4e-5);  // 0.027 and 0.023 mm by the normal equations
}

// A second camera half a metre to the right, turned inwards.
Eigen::Isometry3d SecondCamera() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(0.15, Eigen::Vector3d::UnitY()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(-0.12, 0.01, 0.02);
  return pose;
}

void ExpectSecondCamera(const Calibration& result) {
  ASSERT_EQ(result.cameras.size(), 2U) << result.message;
  const CalibratedCamera& second = result.cameras[1];
  const Eigen::Matrix<double, 6, 1> sigma = second.cam_from_rig_covariance.diagonal().cwiseSqrt();
  const Eigen::Isometry3d off = second.cam_from_rig * SecondCamera().inverse();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(second.cam_from_rig.translation()[axis], SecondCamera().translation()[axis],
                4 * sigma[3 + axis]);
  }
  const double sigma_rad = sigma.head<3>().norm();
  EXPECT_LT(Eigen::AngleAxisd(off.linear()).angle(), 4 * sigma_rad);
  EXPECT_GT(sigma.minCoeff(), 0);
  // The normal equations give 0.58 mrad and 0.11 mm for twelve chessboards, 0.47 mrad and 0.09 mm for fifteen grids.
  std::printf("sigma of the second camera's turn %.3f mrad, of its place %.3f mm\n", 1000 * sigma_rad,
              1000 * sigma.tail<3>().maxCoeff());
  EXPECT_LT(sigma_rad, 0.87e-3);
  EXPECT_LT(sigma.tail<3>().maxCoeff(), 0.16e-3);
}

TEST(Calibration, RigsBeforeAChessboardAreSolvedWhole) {
  auto rng = TestRng();
  const BoardViews views(GridTarget(), {OpenCv8Camera(), OpenCv8Camera()},
                         {Eigen::Isometry3d::Identity(), SecondCamera()}, Views(12), rng);
  const Calibration result = CalibrateCameras(views.input(), Only("opencv5"));
  ExpectSecondCamera(result);
  EXPECT_NEAR(result.held_out_px, kNoisePx, 0.03 * kNoisePx);
}

CalibrationTarget AprilGrid() {
  Board board;
  board.columns = 6;
  board.rows = 5;
  board.tag_size_m = 0.06;
  board.spacing = 0.3;
  return TargetOf(board);
}

TEST(Calibration, AprilGridsCalibrateCamerasAndRigs) {
  auto rng = TestRng();
  ASSERT_FALSE(AprilGrid().IsGrid());
  const Camera truth = OpenCv8Camera();
  const Calibration single = CalibrateCameras(ViewsOf(truth, Views(16), rng, AprilGrid()), Only("opencv5"));
  ASSERT_TRUE(single.IsUsable()) << single.message;
  EXPECT_NEAR(single.cameras[0].camera.fx_px, truth.fx_px,
              4 * SigmaFxPx(single.cameras[0], 0.68));  // 0.45 px
  const BoardViews rig(AprilGrid(), {truth, truth}, {Eigen::Isometry3d::Identity(), SecondCamera()},
                       Views(15), rng);
  ExpectSecondCamera(CalibrateCameras(rig.input(), Only("opencv5")));
}

// Tags on two walls and the floor of a room corner.
CalibrationTarget RoomTags() {
  std::vector<SurveyedTag> survey;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  for (int i = 0; i < 12; ++i) {
    const double u = 0.3 + 0.55 * (i % 4), v = 0.4 + 0.7 * (i / 4);
    survey.push_back({3 * i, 0.16, u * x + v * z, y, z});
    survey.push_back({3 * i + 1, 0.16, u * y + v * z, x, z});
    survey.push_back({3 * i + 2, 0.16, u * x + v * y, z, y});
  }
  return TargetOf(survey);
}

TEST(Calibration, SurveyedTagsOfARoomCalibrateACamera) {
  auto rng = TestRng();
  const Camera truth = OpenCv8Camera();
  CalibrationInput input;
  input.target = RoomTags();
  input.cameras = {{"cam0", truth.width_px, truth.height_px}};
  std::normal_distribution<double> noise(0, 0.1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 14; ++i) {
    const Eigen::Vector3d center(2.6 + 0.6 * uniform(rng), 2.6 + 0.6 * uniform(rng),
                                 1.4 + 0.6 * uniform(rng));
    const Eigen::Vector3d look_at(0.5 + 0.5 * uniform(rng), 0.5 + 0.5 * uniform(rng),
                                  0.7 + 0.4 * uniform(rng));
    Eigen::Matrix3d world_from_cam;
    world_from_cam.col(2) = (look_at - center).normalized();
    world_from_cam.col(0) =
        world_from_cam.col(2).cross(Eigen::Vector3d(0.2 * uniform(rng), 0, 1)).normalized();
    world_from_cam.col(1) = world_from_cam.col(2).cross(world_from_cam.col(0));
    CalibrationImage image{"v" + std::to_string(i), 0, i, {}};
    for (std::size_t k = 0; k < input.target.points.size(); ++k) {
      Eigen::Vector2d pixel =
          support::OpenCvPixel(truth, world_from_cam.transpose() * (input.target.points[k] - center));
      const bool is_seen =
          pixel.x() > 0 && pixel.y() > 0 && pixel.x() < truth.width_px && pixel.y() < truth.height_px;
      pixel += Eigen::Vector2d(noise(rng), noise(rng));
      // One tag was moved since the survey.
      if (k / 4 == 7) pixel.x() += 25;
      if (is_seen) image.corners.push_back({static_cast<int>(k), pixel, 0.1});
    }
    input.images.push_back(image);
  }
  const Calibration result = CalibrateCameras(input, Only("opencv5"));
  ASSERT_TRUE(result.converged) << result.message;
  // 0.068 px: 1700 corners of 0.1 px that do not lie in a plane.
  EXPECT_NEAR(result.cameras[0].camera.fx_px, truth.fx_px, 4 * SigmaFxPx(result.cameras[0], 0.10));
  EXPECT_NEAR(result.held_out_px, 0.1, 0.01);
  EXPECT_GT(result.outlier_share, 0);
  EXPECT_FALSE(result.cameras[0].coverage.is_flat);
}

TEST(Calibration, WhatDeterminesNothingIsSaidAndNeverThrown) {
  auto rng = TestRng();
  const Camera camera = OpenCv8Camera();
  CalibrationInput input = ViewsOf(camera, Views(2), rng);
  const Calibration two = CalibrateCameras(input, Only("opencv5"));
  EXPECT_FALSE(two.IsUsable());
  EXPECT_NE(NoteOf(two, "few_images"), nullptr);
  for (CalibrationImage& image : input.images) image.corners.resize(3);
  const Calibration three_corners = CalibrateCameras(input);
  EXPECT_FALSE(three_corners.converged);
  EXPECT_THAT(three_corners.message, HasSubstr("no image with"));
  for (CalibrationImage& image : input.images) image.corners.clear();
  EXPECT_FALSE(CalibrateCameras(input).IsUsable());
  input.images.clear();
  EXPECT_FALSE(CalibrateCameras(input).IsUsable());
  CalibrationInput line = ViewsOf(camera, Views(6), rng);
  for (CalibrationImage& image : line.images) {
    image.corners.erase(std::remove_if(image.corners.begin(), image.corners.end(),
                                       [](const BoardCorner& c) { return c.index >= 12; }),
                        image.corners.end());
  }
  EXPECT_FALSE(CalibrateCameras(line, Only("opencv4")).IsUsable()) << "a line is no board";
}

TEST(Calibration, AnImageOfAnotherBoardIsNamed) {
  auto rng = TestRng();
  CalibrationInput input = ViewsOf(OpenCv8Camera(), Views(12), rng);
  std::uniform_real_distribution<double> anywhere(50, 900);
  for (BoardCorner& corner : input.images[4].corners) corner.pixel = {anywhere(rng), anywhere(rng)};
  const Calibration result = CalibrateCameras(input, Only("opencv5"));
  ASSERT_TRUE(result.converged);
  const CalibrationNote* const note = NoteOf(result, "image_rejected");
  ASSERT_NE(note, nullptr);
  EXPECT_THAT(note->message, HasSubstr("cam0_4"));
  EXPECT_LT(result.outlier_share, 0.01);
}

// The seed places the board by corners that are right to 15 px; the fit then finds hardly any that is right.
TEST(Calibration, AnImageThatKeepsTooFewCornersIsNamedAndCountsForNothing) {
  auto rng = TestRng();
  const CalibrationInput good = ViewsOf(OpenCv8Camera(), Views(14), rng);
  CalibrationInput spoilt = good, without = good;
  std::uniform_real_distribution<double> off(-15, 15);
  for (BoardCorner& corner : spoilt.images[4].corners) corner.pixel += Eigen::Vector2d(off(rng), off(rng));
  without.images.erase(without.images.begin() + 4);
  const Calibration result = CalibrateCameras(spoilt, Only("opencv5"));
  const Calibration expected = CalibrateCameras(without, Only("opencv5"));
  ASSERT_TRUE(result.converged && expected.converged) << result.message << expected.message;
  const CalibrationNote* const note = NoteOf(result, "image_rejected");
  ASSERT_NE(note, nullptr);
  EXPECT_THAT(note->message, HasSubstr("cam0_4"));
  EXPECT_EQ(NoteOf(expected, "image_rejected"), nullptr);
  const double sigma_px = SigmaFxPx(expected.cameras[0], 0.52);  // 0.34 px
  // Outliers of the other images may be judged otherwise, by the noise of earlier rounds.
  EXPECT_NEAR(result.cameras[0].camera.fx_px, expected.cameras[0].camera.fx_px, 0.2 * sigma_px);
  EXPECT_NEAR(result.noise_px, expected.noise_px, 0.02 * expected.noise_px);
  EXPECT_NEAR(result.cameras[0].median_sigma_px, expected.cameras[0].median_sigma_px,
              0.05 * expected.cameras[0].median_sigma_px);
}

TEST(Calibration, ProgrammersErrorsAreThrown) {
  auto rng = TestRng();
  CalibrationInput input = ViewsOf(OpenCv8Camera(), Views(3), rng);
  CalibrateCamerasOptions options;
  options.folds = 1;
  EXPECT_THROW(CalibrateCameras(input, options), std::invalid_argument);
  input.images[0].corners[0].pixel.x() = std::nan("");
  EXPECT_THROW(CalibrateCameras(input), std::invalid_argument);
  input.images[0].corners[0] = input.images[0].corners[1];
  EXPECT_THROW(CalibrateCameras(input), std::invalid_argument);
  input.images[0].camera = 1;
  EXPECT_THROW(CalibrateCameras(input), std::invalid_argument);
}

// The circle of a lens of 180 degrees takes less than half of this picture. Nothing can be seen in the rest.
TEST(Calibration, AWideCameraIsJudgedWithinItsImageCircle) {
  auto rng = TestRng();
  Camera truth;
  truth.lens = LensModel::kFisheye;
  truth.width_px = 1600;
  truth.height_px = 1000;
  truth.fx_px = truth.fy_px = 480 / (M_PI / 2);
  truth.cx_px = 799.5;
  truth.cy_px = 499.5;
  BoardViewsOptions views = WideViews(60);
  views.reach = 1.6;
  const Calibration result = CalibrateCameras(ViewsOf(truth, views, rng), Only("fisheye"));
  ASSERT_TRUE(result.converged) << result.message;
  const CalibratedCamera& camera = result.cameras.front();
  std::printf("circle %.1f px, uncertain %.3f, covered %.2f\n", camera.circle.radius_px,
              camera.uncertain_share, camera.coverage.covered_share);
  EXPECT_NEAR(camera.circle.radius_px, 480, 5);
  EXPECT_LT(camera.uncertain_share, 0.02);
  EXPECT_EQ(NoteOf(result, "uncertain_projection"), nullptr);
  EXPECT_EQ(NoteOf(result, "coverage"), nullptr);
  EXPECT_TRUE(result.IsUsable());
}

}  // namespace
}  // namespace luxfit
