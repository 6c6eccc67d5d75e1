#include "inverse/observe/seen_luminaires.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/inverse/observe/lamp_photos.h"
#include "tests/support/calib/look_at.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using support::LampScene;
using support::LuminousRectangle;

Camera WideCamera() {
  Camera camera;
  camera.width_px = 480;
  camera.height_px = 360;
  camera.fx_px = camera.fy_px = 340;
  camera.cx_px = 239.5;
  camera.cy_px = 179.5;
  camera.distortion = {-0.11, 0.06, 4e-4, -7e-4};
  return camera;
}

const PixelDirections& Directions() {
  static const PixelDirections directions = UnprojectAllPixels(WideCamera());
  return directions;
}

// A room of 6 m x 4 m x 2.8 m with a table, seen by five views.
class SeenLuminaires : public testing::Test {
 protected:
  SeenLuminaires() : cameras_{WideCamera()} {
    Scene scene = support::ClosedRoom({6, 4, 2.8});
    support::AddParallelogram(scene, {2, 1, 0.74}, {1.6, 0, 0}, {0, 1, 0}, "table");
    room_ = std::make_unique<Room>(MakeRoom(scene, {{2, 2}, {1}}));
    const std::vector<Eigen::Vector3d> eyes = {
        {0.4, 0.4, 1.6}, {5.6, 3.6, 1.6}, {0.5, 3.5, 1.5}, {5.5, 0.5, 1.4}, {3, 0.3, 1.6}};
    for (const Eigen::Vector3d& eye : eyes) {
      RegisteredView view;
      view.cam_from_world = support::LookAt(eye, {3, 2, 1.8});
      views_.push_back(view);
    }
  }

  PhotoBlobs Seen(const LampScene& scene, int view, int state, double exposure_s = 0.25) const {
    const Photo photo = support::PhotographLamps(
        scene, cameras_[0], Directions(), views_[static_cast<size_t>(view)].cam_from_world, exposure_s);
    return {view, state, FindBrightBlobs(ToRelativeLuminance(photo, exposure_s))};
  }
  std::vector<PhotoBlobs> SeenByAll(const LampScene& scene, int state = 0) const {
    std::vector<PhotoBlobs> photos;
    for (int v = 0; v < static_cast<int>(views_.size()); ++v) photos.push_back(Seen(scene, v, state));
    return photos;
  }
  std::vector<SeenPlace> Find(const std::vector<PhotoBlobs>& photos) const {
    return FindSeenLuminaires(*room_, cameras_, views_, photos);
  }

  std::vector<Camera> cameras_;
  std::vector<RegisteredView> views_;
  std::unique_ptr<Room> room_;
};

TEST_F(SeenLuminaires, APanelHasItsPlaceAndArea) {
  const LuminousRectangle panel{{2.7, 2.3, 2.79}, {0.3, 0.3}, 100};
  const auto places = Find(SeenByAll({{panel}, {}, {}}));
  ASSERT_EQ(places.size(), 1u);
  EXPECT_GE(places[0].views, 3);
  EXPECT_EQ(places[0].missing, 0);
  // The middle of a photo's quadrilateral is not the photo of the middle: centimetres, and said to be.
  EXPECT_LT((places[0].position - panel.center).norm(), 0.03) << places[0].position.transpose();
  EXPECT_LT((places[0].position - panel.center).norm(), 3 * places[0].sigma_m);
  EXPECT_NEAR(places[0].area_m2, 0.36, 0.03);  // a pixel of the outline is 3 % of it
  EXPECT_EQ(places[0].states, std::vector<int>{0});
}

TEST_F(SeenLuminaires, AShortExposureDoesAsWell) {
  const LuminousRectangle panel{{2.7, 2.3, 2.79}, {0.3, 0.3}, 100};
  std::vector<PhotoBlobs> photos;
  for (int v = 0; v < 5; ++v) photos.push_back(Seen({{panel}, {}, {}}, v, 0, 0.009));  // 0.9 of full scale
  const auto places = Find(photos);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_LT((places[0].position - panel.center).norm(), 0.03);
}

TEST_F(SeenLuminaires, SeveralLampsAreTheirOwnPlaces) {
  const LampScene scene{{{{1.5, 2.0, 2.79}, {0.3, 0.3}, 100}, {{2.9, 0.9, 2.78}, {0.05, 0.05}, 300}}, {}, {}};
  const auto places = Find(SeenByAll(scene));
  for (const LuminousRectangle& lamp : scene.lamps) {
    bool found = false;
    for (const SeenPlace& place : places)
      found = found || (place.position - lamp.center).norm() < 3 * place.sigma_m;
    EXPECT_TRUE(found) << lamp.center.transpose();
  }
}

// A glossy counter mirrors a low lamp: its image below the floor is as well triangulated as the lamp itself.
TEST_F(SeenLuminaires, MirrorImagesLieOutsideTheRoom) {
  const LuminousRectangle lamp{{2.7, 1.6, 1.9}, {0.1, 0.1}, 100};
  const LuminousRectangle counter{{3, 2, 0.74}, {2.9, 1.9}, 0};
  for (RegisteredView& view : views_)
    view.cam_from_world = support::LookAt(view.cam_from_world.inverse().translation(), {2.7, 1.6, 0.7});
  const auto photos = SeenByAll({{lamp}, {counter}, {}});
  int with_both = 0;
  for (const PhotoBlobs& photo : photos) with_both += photo.blobs.size() == 2 ? 1 : 0;
  ASSERT_GE(with_both, 3);
  const auto places = Find(photos);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_LT((places[0].position - lamp.center).norm(), 3 * places[0].sigma_m);
}

// Two views were exposed so long that a lit part of the table is washed out; three show that it is no lamp.
TEST_F(SeenLuminaires, AWashedOutSurfaceIsNotOneInShorterExposures) {
  const LampScene scene{{}, {}, {{{2.8, 1.5, 0.741}, {0.2, 0.2}, 3.5}}};
  std::vector<PhotoBlobs> photos;
  for (int v = 0; v < 5; ++v) photos.push_back(Seen(scene, v, 0, v < 2 ? 0.5 : 0.1));
  ASSERT_EQ(photos[0].blobs.size() + photos[1].blobs.size(), 2u);
  EXPECT_TRUE(Find(photos).empty());
  // Where nothing contradicts, it stays a candidate.
  photos.resize(2);
  EXPECT_EQ(Find(photos).size(), 1u);
}

TEST_F(SeenLuminaires, StatesOfOnePlaceAreCollected) {
  const LuminousRectangle a{{1.5, 2.0, 2.79}, {0.3, 0.3}, 100}, b{{4.2, 2.6, 2.79}, {0.3, 0.3}, 100};
  std::vector<PhotoBlobs> photos = SeenByAll({{a}, {}, {}}, 0);
  for (const PhotoBlobs& photo : SeenByAll({{b}, {}, {}}, 1)) photos.push_back(photo);
  for (const PhotoBlobs& photo : SeenByAll({{a, b}, {}, {}}, 2)) photos.push_back(photo);
  const auto places = Find(photos);
  ASSERT_EQ(places.size(), 2u);
  for (const SeenPlace& place : places) {
    const bool is_a = place.position.x() < 3;
    EXPECT_EQ(place.states, (std::vector<int>{is_a ? 0 : 1, 2}));
  }
}

TEST_F(SeenLuminaires, NothingBrightIsNoPlace) {
  EXPECT_TRUE(Find(SeenByAll({})).empty());
  EXPECT_TRUE(Find({}).empty());
  PhotoBlobs wrong;
  wrong.view = 9;
  EXPECT_THROW(Find({wrong}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
