#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgproc.hpp>

#include "calib/targets/board.h"
#include "tests/support/calib/board_render.h"
#include "tests/support/calib/sample_boards.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using ::testing::HasSubstr;

Camera BentCamera() {
  Camera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx_px = 560;
  camera.fy_px = 559;
  camera.cx_px = 322.3;
  camera.cy_px = 236.8;
  camera.distortion = {-0.12, 0.06, 4e-4, -7e-4};
  return camera;
}

Board AprilGrid(int columns, int rows) { return support::AprilGrid(columns, rows, 0.05); }
Board Chessboard(int columns, int rows) { return support::Chessboard(columns, rows, 0.03); }
Board Charuco(int columns, int rows) { return support::Charuco(columns, rows, 0.04, 0.028); }

// The board's middle on the optical axis at that distance, turned about the viewing axis, then tilted about
// an axis of the photo.
Eigen::Isometry3d Pose(const Board& board, double distance_m, double turn_rad,
                       const Eigen::Vector2d& tilt_rad) {
  const Eigen::Vector3d middle = BoardCorners(board).back() / 2;
  const Eigen::AngleAxisd tilt(
      tilt_rad.norm(), tilt_rad.norm() > 0 ? Eigen::Vector3d(tilt_rad.x(), tilt_rad.y(), 0).normalized()
                                           : Eigen::Vector3d::UnitX());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = (tilt * Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ())).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(0, 0, distance_m) - pose.linear() * middle;
  return pose;
}

struct Errors {
  int corners = 0, expected = 0;
  Eigen::Vector2d mean_px = Eigen::Vector2d::Zero();
  double rms_px = 0, largest_px = 0;  // rms per axis
  double normalised = 0;              // rms of error over sigma_px
};

Errors Compare(const BoardDetection& detection, const Board& board, const Camera& camera,
               const Eigen::Isometry3d& cam_from_board) {
  Errors errors;
  const std::vector<Eigen::Vector3d> corners = BoardCorners(board);
  errors.expected = static_cast<int>(corners.size());
  errors.corners = static_cast<int>(detection.corners.size());
  for (const BoardCorner& corner : detection.corners) {
    const Eigen::Vector2d error =
        corner.pixel - Project(camera, cam_from_board * corners[static_cast<std::size_t>(corner.index)]);
    errors.mean_px += error / errors.corners;
    errors.rms_px += error.squaredNorm() / (2 * errors.corners);
    errors.normalised += error.squaredNorm() / (2 * errors.corners * corner.sigma_px * corner.sigma_px);
    errors.largest_px = std::max(errors.largest_px, error.cwiseAbs().maxCoeff());
  }
  errors.rms_px = std::sqrt(errors.rms_px);
  errors.normalised = std::sqrt(errors.normalised);
  return errors;
}

struct Case {
  const char* name;
  Board board;
  BoardStyle style;
  double distance_m;
};

std::vector<Case> AllKinds() {
  return {{"plain grid", AprilGrid(5, 4), {1, false}, 0.55},
          {"kalibr grid", AprilGrid(5, 4), {2, true}, 0.55},
          {"touching grid, 1 bit", AprilGrid(5, 4), {1, true}, 0.55},
          {"plain grid, 2 bits", AprilGrid(5, 4), {2, false}, 0.55},
          {"chessboard", Chessboard(9, 6), {}, 0.6},
          {"charuco", Charuco(8, 6), {}, 0.6}};
}

// What each kind reaches at these sizes (tags of 40 to 50 px, squares of 30 px), with room for other random
// numbers: rms 0.022 to 0.035 px without noise, 0.025 to 0.05 with noise of 2.5 % of the contrast.
constexpr double kNoiselessRmsPx = 0.045, kNoisyRmsPx = 0.065;

TEST(BoardDetectTest, EveryKindIsFoundWhereItIsWithAnHonestSigma) {
  const Camera camera = BentCamera();
  const support::BoardRenderer renderer(camera);
  std::mt19937_64 rng = support::TestRng();
  for (const Case& c : AllKinds()) {
    for (const double noise : {0.0, 0.02}) {
      const Eigen::Isometry3d pose = Pose(c.board, c.distance_m, 0.2, {0.4, -0.3});
      support::BoardRenderOptions options;
      options.noise_sigma = noise;
      const ImagePlane grey = renderer.Render(pose, DrawBoard(c.board, c.style), rng, options);
      const BoardDetection detection = DetectBoard(grey, c.board);
      const Errors errors = Compare(detection, c.board, camera, pose);
      EXPECT_EQ(errors.corners, errors.expected) << c.name << " " << detection.message;
      EXPECT_EQ(detection.message, "") << c.name;
      EXPECT_LT(errors.mean_px.norm(), 0.02) << c.name;
      EXPECT_LT(errors.rms_px, noise > 0 ? kNoisyRmsPx : kNoiselessRmsPx) << c.name;
      // Without noise the plain tags' fits err less than their floor of 0.03 px.
      EXPECT_GT(errors.normalised, noise > 0 ? 0.5 : 0.2) << c.name;
      EXPECT_LT(errors.normalised, 1.4) << c.name;
    }
  }
}

// Files for display hold grey^(1 / 2.2): edges move, saddles do not, and the fit of plain tags finds out.
TEST(BoardDetectTest, ADisplayCurveDoesNotMoveCorners) {
  const Camera camera = BentCamera();
  const support::BoardRenderer renderer(camera);
  std::mt19937_64 rng = support::TestRng();
  for (const Case& c : AllKinds()) {
    const Eigen::Isometry3d pose = Pose(c.board, c.distance_m, -0.3, {-0.2, 0.35});
    support::BoardRenderOptions options;
    options.gamma = 2.2;
    options.levels = 255;
    const ImagePlane grey = 255 * renderer.Render(pose, DrawBoard(c.board, c.style), rng, options);
    const Errors errors = Compare(DetectBoard(grey, c.board), c.board, camera, pose);
    EXPECT_EQ(errors.corners, errors.expected) << c.name;
    EXPECT_LT(errors.rms_px, kNoiselessRmsPx) << c.name;
    std::printf("%s: rms error over sigma %.2f\n", c.name, errors.normalised);
    EXPECT_GT(errors.normalised, 0.2) << c.name;  // as above
    EXPECT_LT(errors.normalised, 1.4) << c.name;
  }
}

// The default print, large tags in a lens that bends their sides by pixels: 0.9 px and sigmas nine times too
// small if tags were taken for straight.
TEST(BoardDetectTest, ALensThatBendsTagsDoesNotMoveTheirCorners) {
  std::mt19937_64 rng = support::TestRng();
  Camera camera = BentCamera();
  camera.fx_px = camera.fy_px = 450;
  camera.distortion = {-0.25, 0.03};
  Board board = AprilGrid(4, 3);
  board.tag_size_m = 0.1;
  const Eigen::Isometry3d pose = Pose(board, 0.5, 0.1, {0.25, 0.15});
  const ImagePlane grey = support::BoardRenderer(camera).Render(pose, DrawBoard(board), rng);
  const Errors errors = Compare(DetectBoard(grey, board), board, camera, pose);
  EXPECT_EQ(errors.corners, errors.expected);
  EXPECT_LT(errors.rms_px, kNoiselessRmsPx);
  std::printf("rms error over sigma %.2f\n", errors.normalised);
  EXPECT_GT(errors.normalised, 0.2);  // as above
  EXPECT_LT(errors.normalised, 1.4);
}

// Every board at four turns about the viewing axis keeps its numbers; a grid cut off by the photo's edge too.
TEST(BoardDetectTest, TurnedAndCutOffBoardsKeepTheirNumbers) {
  const Camera camera = BentCamera();
  const support::BoardRenderer renderer(camera);
  std::mt19937_64 rng = support::TestRng();
  support::BoardRenderOptions options;
  options.samples_per_axis = 2;
  for (const Case& c : {AllKinds()[0], AllKinds()[1], AllKinds()[4], AllKinds()[5]}) {
    for (const double turn_rad : {1.6, 3.1, 4.6}) {
      const Eigen::Isometry3d pose = Pose(c.board, 1.25 * c.distance_m, turn_rad, {0.2, 0.2});
      const ImagePlane grey = renderer.Render(pose, DrawBoard(c.board, c.style), rng, options);
      const Errors errors = Compare(DetectBoard(grey, c.board), c.board, camera, pose);
      EXPECT_EQ(errors.corners, errors.expected) << c.name << " " << turn_rad;
      EXPECT_LT(errors.largest_px, 1) << c.name << " " << turn_rad;
    }
  }
  for (const Case& c : {AllKinds()[0], AllKinds()[1], AllKinds()[5]}) {
    Eigen::Isometry3d pose = Pose(c.board, c.distance_m, 0.1, {0, 0.3});
    pose.translation().x() += 0.25;
    const ImagePlane grey = renderer.Render(pose, DrawBoard(c.board, c.style), rng, options);
    const BoardDetection detection = DetectBoard(grey, c.board);
    const Errors errors = Compare(detection, c.board, camera, pose);
    EXPECT_GE(errors.corners, errors.expected / 4) << c.name;
    EXPECT_LT(errors.corners, errors.expected) << c.name;
    EXPECT_LT(errors.largest_px, 1) << c.name;
    EXPECT_THAT(detection.message, HasSubstr("found")) << c.name;
  }
}

TEST(BoardDetectTest, AMislabelledGridIsRefusedWithTheReason) {
  const Camera camera = BentCamera();
  std::mt19937_64 rng = support::TestRng();
  const Board board = AprilGrid(5, 4);
  const ImagePlane grey = support::BoardRenderer(camera).Render(Pose(board, 0.55, 0.1, {0.2, 0.1}),
                                                                DrawBoard(board, {2, true}), rng);
  const auto message = [&](const Board& as) {
    const BoardDetection detection = DetectBoard(grey, as);
    EXPECT_TRUE(detection.corners.empty());
    return detection.message;
  };
  EXPECT_THAT(message(AprilGrid(4, 5)), HasSubstr("check columns, rows and first_id"));
  Board other = board;
  other.spacing = 0.2;
  EXPECT_THAT(message(other),
              testing::ContainsRegex("the gaps between tags measure 0.(29|30).* tag sizes, the "
                                     "board says 0.2; check spacing"));
  other = board;
  other.first_id = 100;
  EXPECT_THAT(message(other), HasSubstr("no tag of the board was found (tag36h11, ids 100 to 119)"));
  EXPECT_THAT(message(Charuco(8, 6)), HasSubstr("no marker of the board was found"));
}

// Returns a board of 7 x 6 squares of 40 px as OpenCV draws it, without a margin. OpenCV 4.6 marks the other half of the squares where
// the number of rows is even; from 4.7 on, that is its legacy pattern.
cv::Mat CharucoByOpenCv() {
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
  cv::Mat drawn;
#if CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 7)
  cv::aruco::CharucoBoard board(cv::Size(7, 6), 0.04f, 0.028f, dictionary);
  board.setLegacyPattern(true);
  board.generateImage(cv::Size(7 * 40, 6 * 40), drawn, 0, 1);
#else
  cv::aruco::CharucoBoard::create(7, 6, 0.04f, 0.028f, dictionary)
      ->draw(cv::Size(7 * 40, 6 * 40), drawn, 0, 1);
#endif
  return drawn;
}

TEST(BoardDetectTest, OpenCvsOwnCharucoIsFoundWithoutItsHalfPixel) {
  const Board board = Charuco(7, 6);
  cv::Mat drawn = CharucoByOpenCv();
  cv::copyMakeBorder(drawn, drawn, 40, 40, 40, 40, cv::BORDER_CONSTANT, cv::Scalar(255));
  cv::GaussianBlur(drawn, drawn, {0, 0}, 0.7);
  const ImagePlane grey = Eigen::Map<Eigen::Array<uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
                              drawn.data, drawn.rows, drawn.cols)
                              .cast<float>();
  const BoardDetection detection = DetectBoard(grey, board);
  ASSERT_EQ(detection.corners.size(), 30u) << detection.message;
  for (const BoardCorner& corner : detection.corners) {
    const Eigen::Vector2d truth(80 + 40 * (corner.index % 6) - 0.5, 80 + 40 * (corner.index / 6) - 0.5);
    EXPECT_LT((corner.pixel - truth).norm(), 0.03) << corner.index;
  }
}

std::vector<Board> OneOfEachType() { return {AprilGrid(5, 4), Chessboard(9, 6), Charuco(8, 6)}; }

void ExpectNothing(const ImagePlane& grey, const std::string& what) {
  for (const Board& board : OneOfEachType()) {
    const BoardDetection detection = DetectBoard(grey, board);
    EXPECT_TRUE(detection.corners.empty()) << what;
    EXPECT_NE(detection.message, "") << what;
  }
}

TEST(BoardDetectTest, PhotosWithoutABoardGiveNothingAndSaySo) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  ExpectNothing(ImagePlane(), "empty");
  for (const int side : {1, 2, 15, 16, 17, 200}) ExpectNothing(ImagePlane::Constant(side, side, 1), "white");
  ExpectNothing(ImagePlane::Zero(1, 300), "a line");
  ExpectNothing(ImagePlane::Zero(200, 300), "black");
  ExpectNothing(ImagePlane::Constant(200, 300, nan), "NaN");
  ExpectNothing(ImagePlane::Constant(200, 300, infinity), "infinite");
  ExpectNothing(ImagePlane::Constant(200, 300, -1), "negative");
  std::mt19937_64 rng = support::TestRng();
  for (const int scale : {1, 4, 16}) {
    std::uniform_real_distribution<float> uniform(0, 1);
    const ImagePlane coarse = ImagePlane::NullaryExpr(40, 50, [&](Eigen::Index) { return uniform(rng); });
    const ImagePlane grey = ImagePlane::NullaryExpr(
        40 * scale, 50 * scale, [&](Eigen::Index v, Eigen::Index u) { return coarse(v / scale, u / scale); });
    ExpectNothing(grey, "noise");
    ExpectNothing((grey > 0.5f).cast<float>(), "random cells");
  }
}

// Pixels knocked out of photos that show a board: fewer corners, none of them wrong.
TEST(BoardDetectTest, HolesAndClutterCostCornersNotTruth) {
  const Camera camera = BentCamera();
  const support::BoardRenderer renderer(camera);
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> uniform(0, 1);
  support::BoardRenderOptions options;
  options.samples_per_axis = 2;
  for (const Case& c : {AllKinds()[0], AllKinds()[1], AllKinds()[4], AllKinds()[5]}) {
    const Eigen::Isometry3d pose = Pose(c.board, c.distance_m, 0.2, {0.3, -0.2});
    const ImagePlane whole = renderer.Render(pose, DrawBoard(c.board, c.style), rng, options);
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), 0.0f, 0.9f}) {
      ImagePlane grey = whole;
      for (int i = 0; i < 12; ++i) {
        grey.block(static_cast<Eigen::Index>(440 * uniform(rng)),
                   static_cast<Eigen::Index>(600 * uniform(rng)),
                   8 + static_cast<Eigen::Index>(30 * uniform(rng)),
                   8 + static_cast<Eigen::Index>(30 * uniform(rng))) = value;
      }
      const Errors errors = Compare(DetectBoard(grey, c.board), c.board, camera, pose);
      if (c.board.type != BoardType::kChessboard) {  // a chessboard must be seen whole
        EXPECT_GT(errors.corners, errors.expected / 2) << c.name;
      }
      EXPECT_LT(errors.largest_px, 1) << c.name << " " << value;
    }
  }
}

TEST(BoardDetectTest, BadBoardsAreRefused) {
  EXPECT_THROW(DetectBoard(ImagePlane::Zero(100, 100), AprilGrid(0, 4)), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
