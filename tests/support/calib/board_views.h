// Views of a calibration target with known truth: where a camera sees its points, projected by OpenCV.
//
// Boards stand at random places before the camera, tilted up to `tilt_deg` about random axes, so that their
// middles cover the image; points outside the image are left out. Noise is Gaussian per axis.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_BOARD_VIEWS_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_BOARD_VIEWS_H_

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>
#include <string>
#include <vector>

#include "calib/calibrate/calibration_input.h"
#include "calib/lens/camera.h"

namespace luxfit::support {

// By cv::projectPoints or cv::fisheye::projectPoints; NaN behind the camera.
inline Eigen::Vector2d OpenCvPixel(const Camera& camera, const Eigen::Vector3d& p_in_cam) {
  const cv::Matx33d matrix(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
  const std::vector<cv::Point3d> points = {{p_in_cam.x(), p_in_cam.y(), p_in_cam.z()}};
  std::vector<cv::Point2d> pixels;
  if (p_in_cam.z() <= 0) return Eigen::Vector2d::Constant(std::nan(""));
  if (camera.lens == LensModel::kFisheye) {
    const cv::Vec4d k(camera.distortion[0], camera.distortion[1], camera.distortion[2], camera.distortion[3]);
    cv::fisheye::projectPoints(points, pixels, cv::Vec3d::zeros(), cv::Vec3d::zeros(), matrix, k);
  } else {
    const std::vector<double> k(camera.distortion.begin(), camera.distortion.end());
    cv::projectPoints(points, cv::Vec3d::zeros(), cv::Vec3d::zeros(), matrix, k, pixels);
  }
  return {pixels[0].x, pixels[0].y};
}

struct BoardViewsOptions {
  int images = 40;
  double noise_px = 0.3;
  double tilt_deg = 55, least_tilt_deg = 0;
  double nearest_m = 0.35, farthest_m = 0.9;
  double outlier_share = 0;  // of corners, moved by up to outlier_px along both axes
  double outlier_px = 60;
  double reach = 0.85;  // how far from the image's middle boards stand, of half its size
  Eigen::Vector2d bend_m = Eigen::Vector2d::Zero();
};

// A wide angle without extremes, 1280 x 960.
inline Camera OpenCv8Camera() {
  Camera camera;
  camera.width_px = 1280;
  camera.height_px = 960;
  camera.fx_px = 1001.5;
  camera.fy_px = 999.2;
  camera.cx_px = 651.3;
  camera.cy_px = 472.8;
  camera.distortion = {-0.21, 0.11, 4e-4, -6e-4, -0.02, 0.12, -0.02, 0.01};
  return camera;
}

inline Camera FisheyeCamera() {
  Camera camera = OpenCv8Camera();
  camera.lens = LensModel::kFisheye;
  camera.fx_px = 501.3;
  camera.fy_px = 500.4;
  camera.distortion = {0.03, -0.012, 0.004, -0.001};
  return camera;
}

// A chessboard's corners.
inline CalibrationTarget GridTarget(int columns = 12, int rows = 9, double spacing_m = 0.05) {
  Board board;
  board.type = BoardType::kChessboard;
  board.columns = columns;
  board.rows = rows;
  board.square_size_m = spacing_m;
  return TargetOf(board);
}

class BoardViews {
 public:
  // Further cameras of a rig are given by their poses against the first.
  BoardViews(CalibrationTarget target, std::vector<Camera> cameras,
             std::vector<Eigen::Isometry3d> cam_from_rig, const BoardViewsOptions& options,
             std::mt19937_64& rng)
      : cameras_(std::move(cameras)), cam_from_rig_(std::move(cam_from_rig)), options_(options), rng_(rng) {
    input_.target = std::move(target);
    for (const Camera& camera : cameras_) {
      const std::string id = "cam" + std::to_string(input_.cameras.size());
      input_.cameras.push_back({id, camera.width_px, camera.height_px});
    }
    for (int set = 0; set < options_.images; ++set) AddSet(set);
  }

  const CalibrationInput& input() const { return input_; }

 private:
  double Uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(rng_); }

  Eigen::Vector3d Middle() const {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : input_.target.points) box.extend(p);
    return box.center();
  }

  // The target's pose before the first camera.
  Eigen::Isometry3d RandomPose() {
    const Camera& camera = cameras_.front();
    const double around = Uniform(0, 2 * 3.14159265358979323846), roll = Uniform(-0.6, 0.6);
    const double tilt = Uniform(options_.least_tilt_deg, options_.tilt_deg) * 3.14159265358979323846 / 180;
    const double distance_m = Uniform(options_.nearest_m, options_.farthest_m);
    const Eigen::Vector3d axis(std::cos(around), std::sin(around), 0);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = (Eigen::AngleAxisd(tilt, axis) * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()))
                        .toRotationMatrix();
    const double half_x = options_.reach * camera.width_px / (2 * camera.fx_px);
    const double half_y = options_.reach * camera.height_px / (2 * camera.fy_px);
    const Eigen::Vector3d place(Uniform(-half_x, half_x), Uniform(-half_y, half_y), 1);
    pose.translation() = distance_m * place - pose.linear() * Middle();
    return pose;
  }

  Eigen::Vector3d Bent(int index) const {
    Eigen::Vector3d p = input_.target.points[static_cast<std::size_t>(index)];
    if (!input_.target.IsGrid()) return p;
    const double x = static_cast<double>(index % input_.target.columns) / (input_.target.columns - 1);
    const double y = static_cast<double>(index / input_.target.columns) / (input_.target.rows - 1);
    p.z() += 4 * options_.bend_m.x() * x * (1 - x) + 4 * options_.bend_m.y() * y * (1 - y);
    return p;
  }

  void AddSet(int set) {
    const Eigen::Isometry3d pose = RandomPose();
    std::normal_distribution<double> noise(0, options_.noise_px);
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      const Camera& camera = cameras_[c];
      CalibrationImage image{
          "cam" + std::to_string(c) + "_" + std::to_string(set), static_cast<int>(c), set, {}};
      for (std::size_t i = 0; i < input_.target.points.size(); ++i) {
        const Eigen::Vector3d p = cam_from_rig_[c] * (pose * Bent(static_cast<int>(i)));
        Eigen::Vector2d pixel = OpenCvPixel(camera, p);
        if (!(pixel.x() > 0 && pixel.y() > 0 && pixel.x() < camera.width_px - 1 &&
              pixel.y() < camera.height_px - 1))
          continue;
        pixel += Eigen::Vector2d(noise(rng_), noise(rng_));
        if (Uniform(0, 1) < options_.outlier_share)
          pixel += Eigen::Vector2d(Uniform(-1, 1), Uniform(-1, 1)) * options_.outlier_px;
        image.corners.push_back({static_cast<int>(i), pixel, 0});
      }
      input_.images.push_back(std::move(image));
    }
  }

  std::vector<Camera> cameras_;
  std::vector<Eigen::Isometry3d> cam_from_rig_;
  BoardViewsOptions options_;
  std::mt19937_64& rng_;
  CalibrationInput input_;
};

inline CalibrationInput ViewsOf(const Camera& camera, const BoardViewsOptions& options, std::mt19937_64& rng,
                                const CalibrationTarget& target = GridTarget()) {
  return BoardViews(target, {camera}, {Eigen::Isometry3d::Identity()}, options, rng).input();
}

// rms over a raster of directions of the pixel difference that no turn of the camera explains, within `reach`
// of half the image's size: what distinguishes two lenses whose cores differ.
inline double LensDifferencePx(const Camera& truth, const Camera& estimate, double reach) {
  constexpr int kSide = 13;
  std::vector<Eigen::Vector3d> directions;
  std::vector<Eigen::Vector2d> pixels;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double x = reach * (2.0 * (i % kSide) / (kSide - 1) - 1),
                 y = reach * (2.0 * (i / kSide) / (kSide - 1) - 1);
    pixels.emplace_back(truth.width_px * (1 + x) / 2, truth.height_px * (1 + y) / 2);
    directions.push_back(Unproject(truth, pixels.back()));
  }
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  double rms_px = 0;
  for (int step = 0; step < 5; ++step) {
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    rms_px = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const Eigen::Vector3d p = turn * directions[i];
      const Projection projection = ProjectWithJacobian(estimate, p);
      Eigen::Matrix3d cross;
      cross << 0, -p.z(), p.y(), p.z(), 0, -p.x(), -p.y(), p.x(), 0;
      const Eigen::Matrix<double, 2, 3> jacobian = -projection.d_pixel_d_point * cross;
      const Eigen::Vector2d residual = projection.pixel - pixels[i];
      hessian += jacobian.transpose() * jacobian;
      gradient += jacobian.transpose() * residual;
      rms_px += residual.squaredNorm() / static_cast<double>(pixels.size());
    }
    const Eigen::Vector3d w = -hessian.ldlt().solve(gradient);
    if (w.norm() > 0) turn = Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix() * turn;
  }
  return std::sqrt(rms_px);
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_BOARD_VIEWS_H_
