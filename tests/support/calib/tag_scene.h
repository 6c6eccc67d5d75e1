// One tag near the middle of a small photo, at a known pose.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_TAG_SCENE_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_TAG_SCENE_H_

#include <Eigen/Geometry>
#include <array>
#include <random>

#include "calib/lens/camera.h"
#include "calib/targets/tags.h"

namespace luxfit::support {

// The tag sits well off the axis of a distorted camera, so that a plain homography would not fit it.
inline Camera OffAxisCamera(int side_px = 120) {
  Camera camera;
  camera.width_px = side_px;
  camera.height_px = side_px;
  camera.fx_px = 742;
  camera.fy_px = 741.2;
  camera.cx_px = -40;
  camera.cy_px = 150;
  camera.distortion = {-0.112, 0.061, 4e-4, -7e-4, 0, 0, 0, 0};
  return camera;
}

struct TagScene {
  SurveyedTag tag;
  Eigen::Isometry3d cam_from_world = Eigen::Isometry3d::Identity();

  std::array<Eigen::Vector2d, 4> CornersPx(const Camera& camera) const {
    std::array<Eigen::Vector2d, 4> corners_px;
    for (std::size_t k = 0; k < 4; ++k)
      corners_px[k] = Project(camera, cam_from_world * TagCornersInWorld(tag)[k]);
    return corners_px;
  }
};

// A tag of about side_px (before its tilt) near the middle of the picture, tilted as given about a random
// axis and turned at random.
inline TagScene MakeTagScene(const Camera& camera, double side_px, double tilt_rad, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  TagScene scene;
  scene.tag.size_m = 0.2;
  scene.tag.center_in_world.setZero();
  const double axis_x = uniform(rng), axis_y = uniform(rng);
  const Eigen::Vector3d axis = Eigen::Vector3d(axis_x, axis_y, 0).normalized();
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(tilt_rad, axis) * Eigen::AngleAxisd(3.14 * uniform(rng), Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
  scene.tag.normal_in_world = -turn.col(2);
  scene.tag.up_in_world = -turn.col(1);
  const double off_x = uniform(rng), off_y = uniform(rng);
  const Eigen::Vector2d middle(camera.width_px / 2.0 + 3 * off_x, camera.height_px / 2.0 + 3 * off_y);
  scene.cam_from_world.translation() = Unproject(camera, middle) * camera.fx_px * scene.tag.size_m / side_px;
  return scene;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_TAG_SCENE_H_
