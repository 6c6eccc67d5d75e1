#include "forward/views/surface_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "forward/light/illuminance.h"
#include "forward/views/illuminance_plane.h"
#include "tests/support/closed_forms.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using support::kPi;

constexpr double kBlack = 1e-6;

Luminaire Panel() {
  Luminaire lamp;
  lamp.position = {1.5, 1, 2.4};
  lamp.shape = LuminaireShape::kRectangle;
  lamp.size_m = {0.6, 0.4};
  lamp.flux_lm = 3000;
  return lamp;
}

Room BoxRoom() { return MakeRoom(support::ClosedRoom({3, 2, 2.5}), {{0.5, 0.25}, {1024}}); }

TEST(RenderView, WithoutReflectionIsTheDirectLightOfEachPixel) {
  const Room room = BoxRoom();
  Eigen::MatrixXd albedo(1, 2);
  albedo << kBlack, 2 * kBlack;
  const LitRoom lit = LightRoom(room, {Panel()}, albedo);
  const Eigen::Vector3d eye(0.4, 0.3, 1.5);
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(1.5, 1, 0), Eigen::Vector3d(2.71, 1.83, 0)}) {
    const Eigen::MatrixXd luminance = RenderView(room, lit, eye, (p - eye).normalized());
    const double expected = support::LambertianRectangleLx(3000, Panel().position, 0.6, 0.4, p) / kPi;
    // 1e-4: interreflection of the black room (1e-6) and 4 x 4 points of the panel at 4 times its size.
    EXPECT_NEAR(luminance(0, 0) / kBlack, expected, 1e-4 * expected);
    EXPECT_NEAR(luminance(0, 1), 2 * luminance(0, 0), 1e-4 * luminance(0, 1));
  }
}

TEST(RenderView, LuminairesShowTheirLuminance) {
  const Room room = BoxRoom();
  const Eigen::MatrixXd albedo = Eigen::MatrixXd::Constant(1, 1, kBlack);
  const Eigen::Vector3d eye(0.5, 0.4, 0.3);
  const auto luminance = [&](const Luminaire& lamp, const Eigen::Vector3d& p) {
    return RenderView(room, LightRoom(room, {lamp}, albedo), eye, (p - eye).normalized())(0, 0);
  };
  const double panel = 3000 / (kPi * 0.6 * 0.4);  // Phi / (pi A), from everywhere
  EXPECT_NEAR(luminance(Panel(), {1.5, 1, 2.4}), panel, 1e-9 * panel);
  EXPECT_NEAR(luminance(Panel(), {1.79, 0.81, 2.4}), panel, 1e-9 * panel);
  EXPECT_LT(luminance(Panel(), {1.81, 0.81, 2.4}), 0.01 * panel);  // past its edge: the ceiling
  Luminaire disc = Panel();
  disc.shape = LuminaireShape::kDisc;
  disc.size_m = {0.6, 0};
  EXPECT_NEAR(luminance(disc, {1.6, 1.1, 2.4}), 3000 / (kPi * kPi * 0.09), 1e-6);
  disc.aim = {0, 0, 1};  // from behind it is not there
  EXPECT_LT(luminance(disc, {1.6, 1.1, 2.4}), 1);
  Luminaire sphere = Panel();
  sphere.shape = LuminaireShape::kSphere;
  sphere.distribution = Distribution::kIsotropic;
  sphere.size_m = {0.2, 0.2};
  EXPECT_NEAR(luminance(sphere, {1.5, 1, 2.4}), 3000 / (4 * kPi * kPi * 0.01), 1e-6);
  EXPECT_LT(luminance(sphere, {1.5, 1.13, 2.4}), 1);
}

TEST(RenderView, NothingBetweenTheLampAndTheEyeIsSeenThrough) {
  Scene scene = support::ClosedRoom({3, 2, 2.5});
  support::AddParallelogram(scene, {0, 0, 2}, {0, 2, 0}, {3, 0, 0}, "shelf");  // faces down
  const Room room = MakeRoom(scene, {{1, 0.5}, {64}});
  const LitRoom lit = LightRoom(room, {Panel()}, Eigen::MatrixXd::Constant(2, 1, kBlack));
  EXPECT_LT(RenderView(room, lit, {1.5, 1, 1}, Eigen::Vector3d(0, 0, 1))(0, 0), 1);
  // Its back is black, whatever falls on it.
  EXPECT_EQ(RenderView(room, lit, {0.2, 0.2, 2.3}, Eigen::Vector3d(0.1, 0.2, -1).normalized())(0, 0), 0);
}

TEST(RenderView, RaysThatAreNoneAndThatMeetNothingAreBlack) {
  Scene scene;
  support::AddParallelogram(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, "floor");
  const Room room = MakeRoom(scene, {{1, 0.5}, {64}});
  const LitRoom lit = LightRoom(room, {}, Eigen::MatrixXd::Constant(1, 3, 0.5));
  Eigen::Matrix3Xd directions(3, 2);
  directions.col(0) = Eigen::Vector3d(0, 0, 1);
  directions.col(1).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(RenderView(room, lit, {0.5, 0.5, 1}, directions), Eigen::MatrixXd::Zero(2, 3));
  EXPECT_THROW(LightRoom(room, {}, Eigen::MatrixXd::Constant(2, 1, 0.5)), std::invalid_argument);
}

TEST(RenderView, LightOfEachLuminaireAddsUpToThatOfAll) {
  const Room room = BoxRoom();
  Eigen::MatrixXd albedo(1, 2);
  albedo << 0.3, 0.7;
  Luminaire spot = Panel();
  spot.shape = LuminaireShape::kPoint;
  spot.position = {0.7, 0.5, 2.2};
  const std::vector<Luminaire> luminaires{Panel(), spot};
  const std::vector<LitRoom> each = LightRoomByEach(room, luminaires, albedo);
  ASSERT_EQ(each.size(), 2u);
  EXPECT_TRUE(LightRoomByEach(room, {}, albedo).empty());
  const Eigen::Vector3d eye(0.4, 0.3, 1.5), down(0.3, 0.5, -1);
  const auto seen = [&](const LitRoom& lit) { return RenderView(room, lit, eye, down.normalized()); };
  const Eigen::MatrixXd all = seen(LightRoom(room, luminaires, albedo));
  EXPECT_TRUE((seen(each[0]) + seen(each[1])).isApprox(all, 1e-5));
  EXPECT_TRUE(seen(each[1]).isApprox(seen(LightRoom(room, {spot}, albedo)), 1e-5));
}

TEST(RenderView, SurfacesShowTheLightThatSensorsReceive) {
  const Room room = BoxRoom();
  Eigen::MatrixXd albedo(1, 2);
  albedo << 0.3, 0.7;
  const LitRoom lit = LightRoom(room, {Panel()}, albedo);
  for (const auto& [u, v] : {std::pair{0.5, 0.5}, {0.21, 0.64}, {0.87, 0.13}}) {
    const Eigen::Vector3d p = room.scene.facets[4].PointAt(u, v);
    const Receivers receivers = MakeReceivers(room, {}, {{p, {0, 0, 1}, {}}});
    const LuminaireVisibility visibility = ComputeVisibility(room, receivers, lit.luminaires);
    const Eigen::MatrixXd luminance =
        RenderView(room, lit, p + Eigen::Vector3d(0, 0, 1), -Eigen::Vector3d::UnitZ());
    for (Eigen::Index c = 0; c < 2; ++c) {
      const double expected =
          3000 * ComputeIlluminance(room, receivers, visibility, lit.luminaires, albedo.col(c)).total(0, 0);
      EXPECT_NEAR(luminance(0, c) * kPi / albedo(0, c), expected, 0.006 * expected);  // 4 or more elements
    }
  }
}

TEST(GridOf, CellsAreEqualAndTheirCentresInside) {
  const PlaneGrid grid = GridOf({{1, 2, 0.8}, {2, 0, 0}, {0, 1, 0}, 0.3});
  EXPECT_EQ(grid.count_u, 7);
  EXPECT_EQ(grid.count_v, 3);
  EXPECT_EQ(grid.normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_NEAR((grid.points.col(0) - Eigen::Vector3d(1 + 1. / 7, 2 + 1. / 6, 0.8)).norm(), 0, 1e-12);
  EXPECT_NEAR((grid.points.rowwise().mean() - Eigen::Vector3d(2, 2.5, 0.8)).norm(), 0, 1e-12);
  EXPECT_THROW(GridOf({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, 0.1}), std::invalid_argument);
  EXPECT_THROW(GridOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, -0.1}), std::invalid_argument);
}

TEST(GridOf, WithoutSpacingFollowsEn12464) {
  // The standard's table of typical values: length 1 m: 0.20 m, 5 points; 5 m: 0.60 m, 8; 10 m: 1.00 m, 10.
  const int expected[][2] = {{1, 5}, {5, 8}, {10, 10}};
  for (const auto& [length, points] : expected)
    EXPECT_EQ(GridOf({{0, 0, 0}, {1.0 * length, 0, 0}, {0, 1.0 * length, 0}, 0}).count_u, points) << length;
  // A corridor is divided by its width.
  EXPECT_EQ(GridOf({{0, 0, 0}, {10, 0, 0}, {0, 1, 0}, 0}).count_v, 5);
}

}  // namespace
}  // namespace luxfit
