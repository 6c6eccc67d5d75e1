#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "calib/board.h"
#include "calib/board_drawing.h"
#include "tests/support/board_render.h"
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

Board AprilGrid(int columns, int rows) {
  Board board;
  board.columns = columns;
  board.rows = rows;
  board.tag_size_m = 0.05;
  board.spacing = 0.3;
  return board;
}

Board Chessboard(int columns, int rows) {
  Board board;
  board.type = BoardType::kChessboard;
  board.columns = columns;
  board.rows = rows;
  board.square_size_m = 0.03;
  return board;
}

Board Charuco(int columns, int rows) {
  Board board;
  board.type = BoardType::kCharuco;
  board.columns = columns;
  board.rows = rows;
  board.square_size_m = 0.04;
  board.tag_size_m = 0.028;
  return board;
}

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

TEST(BoardDetectTest, CornersAreWhereTheyAre) {
  const Camera camera = BentCamera();
  const support::BoardRenderer renderer(camera);
  for (const Case& c : AllKinds()) {
    for (const double gamma : {1.0, 2.2}) 
    for (const double noise : {0.0, 0.02}) {
      std::mt19937_64 rng = support::TestRng();
      const Eigen::Isometry3d pose = Pose(c.board, c.distance_m, 0.2, {0.4, -0.3});
      support::BoardRenderOptions options;
      options.noise_sigma = noise;
      options.gamma = gamma;
      const ImagePlane grey = renderer.Render(pose, DrawBoard(c.board, c.style), rng, options);
      const BoardDetection detection = DetectBoard(grey, c.board);
      const Errors errors = Compare(detection, c.board, camera, pose);
      std::printf("%-22s noise %.2f gamma %.1f: %d of %d, mean %.3f %.3f, rms %.3f, largest %.3f, normalised %.2f %s\n",
                  c.name, noise, gamma, errors.corners, errors.expected, errors.mean_px.x(), errors.mean_px.y(),
                  errors.rms_px, errors.largest_px, errors.normalised, detection.message.c_str());
    }
  }
}

}  // namespace
}  // namespace luxfit
