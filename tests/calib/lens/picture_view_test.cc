#include "calib/lens/picture_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/calib/office_camera.h"

namespace luxfit {
namespace {

constexpr double kPi = 3.14159265358979;

Camera Office() { return OfficeCamera({-0.112, 0.061, 0.0004, -0.0007}); }

Camera PlainPinhole() {
  Camera camera;
  camera.width_px = 40;
  camera.height_px = 30;
  camera.fx_px = camera.fy_px = 50;
  camera.cx_px = 19.5;
  camera.cy_px = 14.5;
  return camera;
}

// An equidistant lens whose circle of 180 degrees lies within the photo.
Camera CircularFisheye() {
  Camera camera;
  camera.lens = LensModel::kFisheye;
  camera.width_px = 240;
  camera.height_px = 200;
  camera.fx_px = camera.fy_px = 58;
  camera.cx_px = 121;
  camera.cy_px = 98.5;
  camera.distortion[0] = -0.01;
  return camera;
}

TEST(PictureViewTest, APlainPinholeStaysAsItIs) {
  const Camera camera = PlainPinhole();
  const PictureView view = PictureViewOf(camera);
  EXPECT_EQ(view.projection, PictureProjection::kPerspective);
  ASSERT_EQ(view.width_px, 40);
  ASSERT_EQ(view.height_px, 30);
  EXPECT_NEAR(AngleAcross(view, 40), 2 * std::atan(0.4), 1e-12);
  const ImagePlane photo = ImagePlane::Random(30, 40);
  EXPECT_LT((Resampled(photo, PlacesInPhoto(view, camera), view) - photo).abs().maxCoeff(), 1e-4);
}

// Places of the pixels of an undistorted picture, by OpenCV.
TEST(PictureViewTest, APinholeTakesDistortionOutAsOpenCvDoes) {
  const Camera camera = Office();
  const PictureView view = PictureViewOf(camera);
  ASSERT_EQ(view.projection, PictureProjection::kPerspective);
  const auto& d = camera.distortion;
  const cv::Matx33d from(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
  const cv::Matx33d to(view.focal_px, 0, (view.width_px - 1) / 2.0, 0, view.focal_px,
                       (view.height_px - 1) / 2.0, 0, 0, 1);
  cv::Mat map_x, map_y;
  cv::initUndistortRectifyMap(from, std::vector<double>(d.begin(), d.end()), cv::noArray(), to,
                              {view.width_px, view.height_px}, CV_32FC1, map_x, map_y);
  const PhotoPlaces places = PlacesInPhoto(view, camera);
  for (int v = 0; v < view.height_px; ++v) {
    for (int u = 0; u < view.width_px; ++u) {
      const Eigen::Vector2f place = places.col(static_cast<Eigen::Index>(v) * view.width_px + u);
      ASSERT_NEAR(place.x(), map_x.at<float>(v, u), 2e-3)
          << u << ", " << v;  // floats, and 1e-3 px at the border
      ASSERT_NEAR(place.y(), map_y.at<float>(v, u), 2e-3) << u << ", " << v;
    }
  }
}

TEST(PictureViewTest, APinholeIsAsLargeAsThePhotoFills) {
  const Camera camera = Office();
  PictureView view = PictureViewOf(camera);
  EXPECT_TRUE(PlacesInPhoto(view, camera).allFinite());
  for (const bool wider : {true, false}) {
    PictureView larger = view;
    (wider ? larger.width_px : larger.height_px) += 2;
    EXPECT_FALSE(PlacesInPhoto(larger, camera).allFinite()) << wider;
  }
}

// Kannala and Brandt's lens by OpenCV, directions by the definition of Radiance's angular view.
TEST(PictureViewTest, AFisheyeBecomesAnAngularHemisphere) {
  const Camera camera = CircularFisheye();
  const PictureView view = PictureViewOf(camera);
  ASSERT_EQ(view.projection, PictureProjection::kAngular);
  // The hemisphere, but for the pixels that do not fit.
  EXPECT_NEAR(AngleAcross(view, view.width_px), kPi, 1.5 / view.focal_px);
  EXPECT_EQ(view.width_px, view.height_px);
  const PhotoPlaces places = PlacesInPhoto(view, camera);
  int outside = 0;
  double worst_px = 0;
  for (int v = 0; v < view.height_px; ++v) {
    for (int u = 0; u < view.width_px; ++u) {
      const double x = (u + 0.5) / view.width_px - 0.5, y = 0.5 - (v + 0.5) / view.height_px;
      const double half = std::hypot(x, y) * AngleAcross(view, view.width_px);  // angle from the axis
      const Eigen::Vector2f place = places.col(static_cast<Eigen::Index>(v) * view.width_px + u);
      if (!place.allFinite()) {
        ++outside;
        EXPECT_GT(half, kPi / 2 - 1e-6);
        continue;
      }
      const double r = half - 0.01 * std::pow(half, 3), across = std::hypot(x, y);
      const double px = camera.cx_px + 58 * (across > 0 ? r * x / across : 0);
      const double py = camera.cy_px - 58 * (across > 0 ? r * y / across : 0);
      worst_px = std::max(worst_px, std::hypot(place.x() - px, place.y() - py));
    }
  }
  EXPECT_LT(worst_px, 1e-3);
  // The corners of a square about a circle.
  EXPECT_NEAR(outside / static_cast<double>(places.cols()), 1 - kPi / 4, 0.01);
}

TEST(PictureViewTest, DirectionsLieWhereTheLensSeesThem) {
  for (const Camera& camera : {Office(), CircularFisheye()}) {
    const PictureView view = PictureViewOf(camera);
    const PhotoPlaces places = PlacesInPhoto(view, camera);
    const Eigen::Vector2d pixel(view.width_px / 3, view.height_px / 4);
    const Eigen::Index at =
        static_cast<Eigen::Index>(pixel.y()) * view.width_px + static_cast<Eigen::Index>(pixel.x());
    EXPECT_LT((Project(camera, 2.5 * DirectionOf(view, pixel)) - places.col(at).cast<double>()).norm(), 1e-3);
  }
}

}  // namespace
}  // namespace luxfit
