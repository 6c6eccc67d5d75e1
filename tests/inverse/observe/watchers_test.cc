#include "inverse/observe/watchers.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

namespace luxfit {
namespace {

RegisteredView View() {
  RegisteredView view;
  view.cam_from_world.linear() =
      Eigen::AngleAxisd(1.9, Eigen::Vector3d(0.4, 0.8, -0.3).normalized()).toRotationMatrix();
  view.cam_from_world.translation() = Eigen::Vector3d(0.3, -0.2, 1.1);
  return view;
}

Camera Phone() {
  Camera camera;
  camera.width_px = 640, camera.height_px = 480;
  camera.fx_px = camera.fy_px = 450;
  camera.cx_px = 322, camera.cy_px = 236;
  camera.distortion[0] = -0.05;
  return camera;
}

// Barrel distortion makes the border hollow: it is followed to within two pixels outwards, and cut off at the corners inwards.
TEST(Watchers, APictureHoldsWhatProjectsIntoIt) {
  const Camera camera = Phone();
  const RegisteredView view = View();
  const std::vector<Watcher> watchers = WatchersOf({camera}, {view}, {{0, 2, {}}, {0, 0, {}}});
  ASSERT_EQ(watchers.size(), 1u);
  EXPECT_EQ(watchers[0].states, (std::vector<int>{2, 0}));
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> any(-1, 1);
  int inside = 0, outside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d in_cam(1.5 * any(rng), 1.5 * any(rng), any(rng) > -0.7 ? 1 : -1);
    const Eigen::Vector2d p = in_cam.z() > 0 ? Project(camera, in_cam) : Eigen::Vector2d::Constant(-100);
    const double margin = std::min({p.x(), p.y(), camera.width_px - 1 - p.x(), camera.height_px - 1 - p.y()});
    if (margin > -2 && margin < 30) continue;
    const Eigen::Vector3d in_world = view.cam_from_world.linear().transpose() * in_cam;
    EXPECT_EQ(IsInPicture(watchers[0], in_world), margin > 0) << p.transpose();
    ++(margin > 0 ? inside : outside);
  }
  EXPECT_GT(inside, 200);
  EXPECT_GT(outside, 200);
}

TEST(Watchers, OneWithoutABorderShowsAllRound) {
  EXPECT_TRUE(IsInPicture({}, {0, 0, -1}));
  EXPECT_TRUE(IsInPicture({}, {1, 0, 0}));
}

}  // namespace
}  // namespace luxfit
