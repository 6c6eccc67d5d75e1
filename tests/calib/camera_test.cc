#include "calib/camera.h"
#include "tests/support/office_camera.h"
#include "tests/support/test_rng.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <opencv2/calib3d.hpp>
#include <random>
#include <stdexcept>
#include <vector>

namespace luxfit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Camera WideCamera() { return OfficeCamera({-0.112, 0.061, 4e-4, -7e-4, -0.013, 0.02, -0.01, 0.004}); }

Eigen::Vector3d RandomPoint(std::mt19937_64& rng) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double z = 3 + 2 * uniform(rng);
  return {0.6 * z * uniform(rng), 0.45 * z * uniform(rng), z};
}

TEST(CameraTest, JacobianMatchesCentralDifferences) {
  std::mt19937_64 rng = support::TestRng();
  const Camera camera = WideCamera();
  for (int i = 0; i < 50; ++i) {
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

TEST(CameraTest, UnprojectInvertsProject) {
  const Camera camera = WideCamera();
  for (int v = 0; v < camera.height_px; v += 40) {
    for (int u = 0; u < camera.width_px; u += 40) {
      const Eigen::Vector2d pixel(u, v);
      const Eigen::Vector3d ray = Unproject(camera, pixel);
      EXPECT_NEAR(ray.norm(), 1, 1e-12);
      EXPECT_LT((Project(camera, 2.5 * ray) - pixel).norm(), 1e-9);
    }
  }
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
  camera.distortion = {-0.5, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_TRUE(Unproject(camera, {camera.cx_px + 395, camera.cy_px}).allFinite());
  EXPECT_TRUE(Unproject(camera, {camera.cx_px + 410, camera.cy_px}).hasNaN());
  EXPECT_TRUE(Unproject(camera, {camera.cx_px + 5000, camera.cy_px}).hasNaN());
}

class ReadCameraTest : public testing::Test {
 protected:
  std::string Write(const std::string& text) {
    path_ = testing::TempDir() + "luxfit_camera_" +
            testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml";
    std::ofstream(path_) << text;
    return path_;
  }
  std::string MessageOf(const std::string& text) {
    try {
      ReadOpenCvCamera(Write(text));
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  }
  void TearDown() override {
    if (!path_.empty()) std::remove(path_.c_str());
  }
  std::string path_;
};

std::string Yaml(const std::string& size, const std::string& matrix, const std::string& distortion) {
  return "%YAML:1.0\n---\n" + size + matrix + distortion;
}
const char* const kSize = "image_width: 960\nimage_height: 720\n";
const char* const kMatrix =
    "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 742., 0., 483.1, 0., 741.2, 356.4, 0., 0., 1. ]\n";
const char* const kDistortion =
    "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
    "   data: [ -0.112, 0.061, 4e-4, -7e-4, 0.01 ]\n";

TEST_F(ReadCameraTest, ReadsWhatOpenCvWrites) {
  const Camera camera = ReadOpenCvCamera(Write(Yaml(kSize, kMatrix, kDistortion)));
  EXPECT_EQ(camera.width_px, 960);
  EXPECT_EQ(camera.height_px, 720);
  EXPECT_EQ(camera.fx_px, 742);
  EXPECT_EQ(camera.fy_px, 741.2);
  EXPECT_EQ(camera.cx_px, 483.1);
  EXPECT_EQ(camera.cy_px, 356.4);
  EXPECT_THAT(camera.distortion, testing::ElementsAre(-0.112, 0.061, 4e-4, -7e-4, 0.01, 0, 0, 0));
}

TEST_F(ReadCameraTest, NamesFileKeyAndWhatWasExpected) {
  const std::string no_width = MessageOf(Yaml("image_height: 720\n", kMatrix, kDistortion));
  EXPECT_THAT(no_width, StartsWith(path_ + ": image_width: expected a number of pixels, got nothing"));
  EXPECT_THAT(MessageOf(Yaml("image_width: -5\nimage_height: 720\n", kMatrix, kDistortion)),
              HasSubstr("image_width: expected a whole number > 0, got -5"));
  EXPECT_THAT(MessageOf(Yaml("image_width: wide\nimage_height: 720\n", kMatrix, kDistortion)),
              HasSubstr("image_width: expected a number"));
  EXPECT_THAT(MessageOf(Yaml(kSize, "", kDistortion)),
              HasSubstr("camera_matrix: expected an !!opencv-matrix"));
  EXPECT_THAT(MessageOf(Yaml(kSize, "camera_matrix: 3\n", kDistortion)),
              HasSubstr("camera_matrix: expected an !!opencv-matrix"));
  const std::string two_by_two =
      "camera_matrix: !!opencv-matrix\n   rows: 2\n   cols: 2\n   dt: d\n   data: [ 1., 0., 0., 1. ]\n";
  EXPECT_THAT(MessageOf(Yaml(kSize, two_by_two, kDistortion)), HasSubstr("expected 3 x 3, got 2 x 2"));
  const std::string negative =
      "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
      "   data: [ -742., 0., 483., 0., 741., 356., 0., 0., 1. ]\n";
  EXPECT_THAT(MessageOf(Yaml(kSize, negative, kDistortion)), HasSubstr("expected focal lengths > 0 px"));
  const std::string six =
      "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 6\n   dt: d\n"
      "   data: [ 0., 0., 0., 0., 0., 0. ]\n";
  EXPECT_THAT(MessageOf(Yaml(kSize, kMatrix, six)),
              HasSubstr("distortion_coefficients: expected 4, 5 or 8 in one row or column, got 1 x 6"));
}

TEST_F(ReadCameraTest, FilesThatAreNoCalibrationAreNamed) {
  const std::string garbage = MessageOf("not yaml at all\n");
  EXPECT_THAT(garbage, StartsWith(path_ + ": cannot read the calibration"));
  EXPECT_THAT(MessageOf("%YAML:1.0\n---\nimage_width: [ 1, 2\n"), StartsWith(path_ + ": "));
  EXPECT_THAT(MessageOf(""), StartsWith(path_ + ": "));
  EXPECT_THROW(ReadOpenCvCamera("no/such.yaml"), std::runtime_error);
}

}  // namespace
}  // namespace luxfit
