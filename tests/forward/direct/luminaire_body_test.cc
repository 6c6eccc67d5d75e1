#include "forward/direct/luminaire_body.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// A room of 4 x 3 x 2.5 m with a cabinet that has no bottom of its own.
Scene RoomWithCabinet() {
  Scene scene = support::ClosedRoom({4, 3, 2.5});
  support::AddBox(scene, {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(2, 2, 1)}, support::Facing::kOutward,
                  {"cabinet"});
  scene.facets.erase(scene.facets.begin() + 6 + 4);
  return scene;
}

Luminaire LampAt(const Eigen::Vector3d& position) {
  Luminaire lamp;
  lamp.position = position;
  return lamp;
}

TEST(ShareOutsideRoom, TellsInsideFromOutside) {
  const RayScene rays(RoomWithCabinet());
  EXPECT_EQ(ShareOutsideRoom(rays, LampAt({3, 1, 2.49})), 0);
  EXPECT_EQ(ShareOutsideRoom(rays, LampAt({1.5, 1.5, 1.01})), 0);
  EXPECT_EQ(ShareOutsideRoom(rays, LampAt({1.5, 1.5, 0.05})), 1);    // sees the floor in it
  EXPECT_EQ(ShareOutsideRoom(rays, LampAt({1.5, 1.5, 0.5})), 1);     // in the cabinet
  EXPECT_EQ(ShareOutsideRoom(rays, LampAt({3, 1, 2.501})), 1);       // recessed behind the ceiling
  EXPECT_EQ(ShareOutsideRoom(rays, LampAt({-1, 1, 1})), 1);          // beyond a wall
  EXPECT_EQ(ShareOutsideRoom(rays, LampAt({3000, 1000, 2500})), 1);  // millimetres
}

TEST(ShareOutsideRoom, IsTheShareOfAPanelThatSticksOut) {
  Luminaire panel = LampAt({4, 1, 2.4});  // half of it beyond the wall x = 4
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = {0.6, 0.6};
  EXPECT_NEAR(ShareOutsideRoom(RayScene(RoomWithCabinet()), panel), 0.5, 1e-12);
}

TEST(LuminaireBodies, StandBehindFlatLuminairesThatShineToOneSide) {
  Luminaire panel = LampAt({2, 1.5, 2.4});
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = {0.6, 0.4};
  panel.heading = {0, 1, 0};
  Luminaire disc = panel;
  disc.shape = LuminaireShape::kDisc;
  Luminaire both_sides = panel;
  both_sides.distribution = Distribution::kIsotropic;
  const Scene room = support::ClosedRoom({4, 3, 2.5});
  EXPECT_EQ(WithLuminaireBodies(room, {both_sides, LampAt({1, 1, 1})}).facets.size(), 6u);
  EXPECT_EQ(WithLuminaireBodies(room, {both_sides}).materials.size(), 1u);

  const Scene with_panel = WithLuminaireBodies(room, {panel});
  ASSERT_EQ(with_panel.facets.size(), 8u);
  ASSERT_EQ(with_panel.materials.back(), kLuminaireBodyMaterial);
  const Facet &front = with_panel.facets[6], &back = with_panel.facets[7];
  EXPECT_NEAR(front.AreaM2(), 0.24, 1e-12);
  EXPECT_NEAR((front.Normal() - panel.aim).norm(), 0, 1e-12);
  EXPECT_NEAR((back.Normal() + panel.aim).norm(), 0, 1e-12);
  EXPECT_NEAR(front.PointAt(0.5, 0.5).z(), 2.4001, 1e-12);  // above the light, so that it does not shade it
  EXPECT_NEAR(back.PointAt(0.5, 0.5).z(), 2.4002, 1e-12);
  EXPECT_NEAR(std::abs(front.edge_u.x()) + std::abs(front.edge_v.x()), 0.4, 1e-12);  // heading is y

  double area_m2 = 0;
  const Scene with_disc = WithLuminaireBodies(room, {disc});
  for (size_t i = 6; i < with_disc.facets.size(); ++i) area_m2 += with_disc.facets[i].AreaM2();
  EXPECT_NEAR(area_m2, 2 * 3.14159265358979323846 * 0.09, 1e-12);
}

}  // namespace
}  // namespace luxfit
