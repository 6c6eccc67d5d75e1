#include "calib/lens/camera.h"
#include "tests/support/calib/office_camera.h"
#include "tests/support/test_rng.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>
#include <vector>

namespace luxfit {
namespace {

Camera WideCamera() { return OfficeCamera({-0.112, 0.061, 4e-4, -7e-4, -0.013, 0.02, -0.01, 0.004}); }

Eigen::Vector3d RandomPoint(std::mt19937_64& rng) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double z = 3 + 2 * uniform(rng);
  return {0.6 * z * uniform(rng), 0.45 * z * uniform(rng), z};
}

Camera Fisheye() {
  Camera camera = OfficeCamera({0.02, -0.01, 3e-3, -4e-4});
  camera.lens = LensModel::kFisheye;
  camera.fx_px = camera.fy_px = 280;
  return camera;
}

// 11 x 8 control points over 150 degrees, each off by some thousandths.
Camera Splined(std::mt19937_64& rng) {
  Camera camera = OfficeCamera({});
  camera.lens = LensModel::kSplined;
  camera.spline = {3, 11, 8, 150, {}};
  std::normal_distribution<double> offset(0, 0.004);
  for (int i = 0; i < 2 * 11 * 8; ++i) camera.spline.control_points.push_back(offset(rng));
  return camera;
}

std::vector<Camera> AllLenses(std::mt19937_64& rng) {
  return {WideCamera(),
          OfficeCamera({-0.112, 0.061, 4e-4, -7e-4, -0.013, 0.02, -0.01, 0.004, 3e-4, -2e-4, 1e-4, 5e-4}),
          Fisheye(), Splined(rng)};
}

TEST(CameraTest, JacobianMatchesCentralDifferences) {
  std::mt19937_64 rng = support::TestRng();
  const std::vector<Camera> cameras = AllLenses(rng);
  for (int i = 0; i < 200; ++i) {
    const Camera& camera = cameras[static_cast<std::size_t>(i) % cameras.size()];
    const Eigen::Vector3d p = RandomPoint(rng);
    const Projection projection = ProjectWithJacobian(camera, p);
    EXPECT_LT((projection.pixel - Project(camera, p)).norm(), 1e-10);  // rounding
    constexpr double kStep = 1e-5;  // error of order step^2: 1e-10 of about 700 px
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector2d difference =
          (Project(camera, p + step) - Project(camera, p - step)) / (2 * kStep);
      EXPECT_LT((difference - projection.d_pixel_d_point.col(axis)).norm(), 1e-5);
    }
  }
}

TEST(CameraTest, AgreesWithOpenCv) {
  std::mt19937_64 rng = support::TestRng();
  const Camera camera = WideCamera();
  const cv::Matx33d k(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d p = RandomPoint(rng);
    std::vector<cv::Point2d> pixel;
    cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0),
                      k, distortion, pixel);
    EXPECT_LT((Project(camera, p) - Eigen::Vector2d(pixel[0].x, pixel[0].y)).norm(), 1e-9);
  }
}

TEST(CameraTest, FisheyeAgreesWithOpenCvUpToTheSideAndBeyond) {
  std::mt19937_64 rng = support::TestRng();
  const Camera camera = Fisheye();
  const cv::Matx33d k(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.begin() + 4);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d p = RandomPoint(rng);
    std::vector<cv::Point2d> pixel;
    cv::fisheye::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, pixel, cv::Vec3d(0, 0, 0),
                               cv::Vec3d(0, 0, 0), k, distortion);
    EXPECT_LT((Project(camera, p) - Eigen::Vector2d(pixel[0].x, pixel[0].y)).norm(), 1e-9);
  }
  // 90 degrees off the axis: theta = pi / 2.
  const double theta = std::acos(0.0), t2 = theta * theta;
  const double radius = theta * (1 + t2 * (0.02 + t2 * (-0.01 + t2 * (3e-3 - 4e-4 * t2))));
  EXPECT_NEAR(Project(camera, {2, 0, 0}).x(), camera.cx_px + 280 * radius, 1e-9);
  EXPECT_TRUE(Project(camera, {2, 0, -0.5}).allFinite());
  EXPECT_TRUE(Project(camera, {0, 0, -1}).hasNaN());
}

TEST(CameraTest, ASplineOfZerosIsStereographic) {
  Camera camera = OfficeCamera({});
  camera.lens = LensModel::kSplined;
  for (const int control_points : {0, 2 * 11 * 8}) {
    if (control_points > 0) camera.spline = {3, 11, 8, 150, std::vector<double>(2 * 11 * 8, 0.0)};
    const double theta = 0.6;
    const Eigen::Vector3d p(0, 3 * std::sin(theta), 3 * std::cos(theta));
    const Eigen::Vector2d expected(camera.cx_px, camera.cy_px + camera.fy_px * 2 * std::tan(theta / 2));
    EXPECT_LT((Project(camera, p) - expected).norm(), 1e-9);
  }
}

TEST(CameraTest, UnprojectInvertsProject) {
  std::mt19937_64 rng = support::TestRng();
  for (const Camera& camera : AllLenses(rng)) {
    for (int v = 0; v < camera.height_px; v += 40) {
      for (int u = 0; u < camera.width_px; u += 40) {
        const Eigen::Vector2d pixel(u, v);
        const Eigen::Vector3d ray = Unproject(camera, pixel);
        EXPECT_NEAR(ray.norm(), 1, 1e-12);
        EXPECT_LT((Project(camera, 2.5 * ray) - pixel).norm(), 1e-8);
      }
    }
  }
}

TEST(CameraTest, PixelsThatAFisheyeCannotShowHaveNoRay) {
  const Camera camera = Fisheye();
  EXPECT_TRUE(Unproject(camera, {camera.cx_px + 5000, camera.cy_px}).hasNaN());
  EXPECT_LT((Unproject(camera, {camera.cx_px, camera.cy_px}) - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(CameraTest, PointsBehindTheCameraHaveNoPixel) {
  const Camera camera = WideCamera();
  EXPECT_TRUE(Project(camera, {0.1, 0.1, -1}).hasNaN());
  EXPECT_TRUE(Project(camera, {0.1, 0.1, 0}).hasNaN());
  EXPECT_TRUE(ProjectWithJacobian(camera, {0.1, 0.1, -1}).d_pixel_d_point.hasNaN());
}

TEST(CameraTest, PixelsThatNoRayReachesHaveNone) {
  Camera camera = WideCamera();
  // r (1 - r^2 / 2) is largest at r^2 = 2/3, where it is 0.544: no ray lands further than 404 px from the
  // centre.
  camera.distortion = {-0.5};
  EXPECT_TRUE(Unproject(camera, {camera.cx_px + 395, camera.cy_px}).allFinite());
  EXPECT_TRUE(Unproject(camera, {camera.cx_px + 410, camera.cy_px}).hasNaN());
  EXPECT_TRUE(Unproject(camera, {camera.cx_px + 5000, camera.cy_px}).hasNaN());
}

}  // namespace
}  // namespace luxfit
