#include "forward/mesh/mesh_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "forward/light/illuminance.h"
#include "forward/light/room.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using support::AddBox;
using support::AddParallelogram;
using support::AddTriangle;
using support::ClosedRoom;
using support::Facing;

constexpr double kAreaRounding = 1e-9;
const Eigen::Vector3d kSize(4, 3, 2.5);
const std::vector<std::string> kMaterials{"wall", "wall", "wall", "wall", "floor", "ceiling"};

double AreaOf(const Scene& scene, const std::string& material) {
  double area = 0;
  for (const Facet& facet : scene.facets) {
    if (scene.materials[static_cast<size_t>(facet.material)] == material) area += facet.AreaM2();
  }
  return area;
}

Scene RoomWithFloorTwice() {
  Scene scene = ClosedRoom(kSize, kMaterials);
  scene.facets.push_back(scene.facets[4]);
  return scene;
}

// Rugs at the floor's height: one askew over the floor's middle, a triangle that covers part of both.
Scene RoomWithRugs() {
  Scene scene = ClosedRoom(kSize, kMaterials);
  AddParallelogram(scene, {1, 0.5, 0}, {1.6, 0.4, 0}, {-0.4, 1.6, 0}, "rug");
  AddTriangle(scene, {1.5, 1, 0}, {2, 0, 0}, {0, 1.5, 0}, "mat");
  return scene;
}

TEST(WithoutOverlaps, LeavesACleanSceneAsItIs) {
  Scene scene = ClosedRoom(kSize, kMaterials);
  AddBox(scene, {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(2, 0.5, 1)}, Facing::kOutward, {"cabinet"});
  const Scene same = WithoutOverlaps(scene);
  ASSERT_EQ(same.facets.size(), scene.facets.size());
  for (size_t f = 0; f < scene.facets.size(); ++f) EXPECT_EQ(same.facets[f].origin, scene.facets[f].origin);
}

TEST(WithoutOverlaps, ACopyGoesAway) {
  const Scene scene = WithoutOverlaps(RoomWithFloorTwice());
  EXPECT_EQ(scene.facets.size(), 6u);
  EXPECT_NEAR(AreaOf(scene, "floor"), 12, kAreaRounding);
}

TEST(WithoutOverlaps, ThreeCopiesLeaveOne) {
  Scene scene = RoomWithFloorTwice();
  scene.facets.push_back(scene.facets[4]);
  EXPECT_NEAR(AreaOf(WithoutOverlaps(scene), "floor"), 12, kAreaRounding);
}

TEST(WithoutOverlaps, TheMaterialWithTheLesserAreaLiesOnTop) {
  const Scene scene = WithoutOverlaps(RoomWithRugs());
  EXPECT_NEAR(AreaOf(scene, "mat"), 1.5, kAreaRounding);  // whole: 1.5 m2 against the rug's 2.72
  EXPECT_NEAR(AreaOf(scene, "floor") + AreaOf(scene, "rug") + AreaOf(scene, "mat"), 12, kAreaRounding);
  EXPECT_LT(AreaOf(scene, "rug"), 1.6 * 1.6 + 0.4 * 0.4 - 0.1);
  EXPECT_TRUE(FindOverlaps(scene).empty());
}

TEST(FindOverlaps, RoundingOfTheFileIsNone) {
  Scene scene;
  AddParallelogram(scene, {0, 0, 0}, {2.000003, 0, 0}, {0, 3, 0}, "floor");
  AddParallelogram(scene, {2, 0, 0}, {2, 0, 0}, {0, 3, 1e-6}, "floor");
  EXPECT_TRUE(FindOverlaps(scene).empty());
}

TEST(FindOverlaps, AMillimetreApartIsNone) {
  Scene scene;
  AddParallelogram(scene, {0, 0, 0}, {2, 0, 0}, {0, 3, 0}, "floor");
  AddParallelogram(scene, {0, 0, 0.001}, {2, 0, 0}, {0, 3, 0}, "rug");
  EXPECT_TRUE(FindOverlaps(scene).empty());
}

Room RoomOf(const Scene& scene) { return MakeRoom(scene, {{0.5, 0.25}, {1024}}); }

// Patches' illuminance for a luminaire of 1000 lm, and the light that comes and goes.
struct Balance {
  double flux_in_lm = 0, absorbed_lm = 0;
  float least_row = 0, most_row = 0;
};
Balance BalanceOf(const Room& room, const Eigen::VectorXd& albedo) {
  Luminaire lamp;
  lamp.position = {2.2, 1.4, 2};
  lamp.distribution = Distribution::kIsotropic;
  std::vector<int> all(room.patches.elements.size());
  for (size_t e = 0; e < all.size(); ++e) all[e] = static_cast<int>(e);
  const Receivers receivers = MakeReceivers(room, all, {});
  const Illuminance light =
      ComputeIlluminance(room, receivers, ComputeVisibility(room, receivers, {lamp}), {lamp}, albedo);
  Balance balance;
  for (size_t e = 0; e < all.size(); ++e) {
    const Element& element = room.patches.elements[e];
    const int material = room.patches.patches[static_cast<size_t>(element.patch)].material;
    balance.flux_in_lm += 1000 * element.area_m2 * light.direct(static_cast<Eigen::Index>(e), 0);
    balance.absorbed_lm +=
        1000 * element.area_m2 * (1 - albedo[material]) * light.total(static_cast<Eigen::Index>(e), 0);
  }
  const Eigen::VectorXf rows = room.form_factors.element_to_patch.rowwise().sum();
  balance.least_row = rows.minCoeff();
  balance.most_row = rows.maxCoeff();
  return balance;
}

// In a closed room every lumen is absorbed. 0.5 %: direct light at the elements' centres, elements of 0.25 m,
// and form factors of 1024 rays made symmetric; counting the floor's 12 of 59 m2 twice would be wrong by 10
// to 20 %.
void ExpectBalance(const Scene& scene, const Eigen::VectorXd& albedo) {
  const Balance balance = BalanceOf(RoomOf(scene), albedo);
  EXPECT_NEAR(balance.least_row, 1, 1e-5);  // float rounding
  EXPECT_NEAR(balance.most_row, 1, 1e-5);
  EXPECT_NEAR(balance.flux_in_lm, 1000, 5);
  EXPECT_NEAR(balance.absorbed_lm, 1000, 5);
}

TEST(WithoutOverlaps, AFloorDrawnTwiceKeepsTheEnergyBalance) {
  ExpectBalance(RoomWithFloorTwice(), Eigen::Vector3d(0.6, 0.3, 0.8));
}

TEST(WithoutOverlaps, RugsAtTheFloorsHeightKeepTheEnergyBalance) {
  Eigen::VectorXd albedo(5);
  albedo << 0.6, 0.3, 0.8, 0.7, 0.1;
  ExpectBalance(RoomWithRugs(), albedo);
}

// The same room with its floor of one facet, of three with T-junctions, and of slivers: what rays see is the
// same.
double CeilingLx(const Scene& scene) {
  const Room room = RoomOf(scene);
  Luminaire lamp;
  lamp.position = {2.2, 1.4, 2};
  const Receivers receivers =
      MakeReceivers(room, {}, {{{1.1, 1.7, 2.4}, {0, 0, -1}}, {{0.5, 0.5, 1}, {1, 0, 0}}});
  const Eigen::Vector3d albedo(0.6, 0.5, 0.8);
  const Illuminance light =
      ComputeIlluminance(room, receivers, ComputeVisibility(room, receivers, {lamp}), {lamp}, albedo);
  const Eigen::VectorXf rows = room.form_factors.element_to_patch.rowwise().sum();
  EXPECT_NEAR(rows.minCoeff(), 1, 1e-5);  // float rounding
  EXPECT_NEAR(rows.maxCoeff(), 1, 1e-5);
  return light.total(0, 0);
}

TEST(Mesh, TJunctionsAndSliversLeaveTheSolutionAsItIs) {
  const double clean = CeilingLx(ClosedRoom(kSize, kMaterials));
  Scene junctions = ClosedRoom(kSize, kMaterials);
  junctions.facets.erase(junctions.facets.begin() + 4);
  AddParallelogram(junctions, {0, 0, 0}, {1.3, 0, 0}, {0, 3, 0}, "floor");
  AddParallelogram(junctions, {1.3, 0, 0}, {2.7, 0, 0}, {0, 1.1, 0}, "floor");
  AddParallelogram(junctions, {1.3, 1.1, 0}, {2.7, 0, 0}, {0, 1.9, 0}, "floor");
  Scene slivers = ClosedRoom(kSize, kMaterials);
  slivers.facets.erase(slivers.facets.begin() + 4);
  const Eigen::Vector3d kink(2, 1.5015, 0);  // just off the diagonal
  AddTriangle(slivers, {0, 0, 0}, {4, 0, 0}, {4, 3, 0}, "floor");
  AddTriangle(slivers, {0, 0, 0}, {4, 3, 0}, kink, "floor");
  AddTriangle(slivers, {0, 0, 0}, kink, {0, 3, 0}, "floor");
  AddTriangle(slivers, {4, 3, 0}, {-4, 0, 0}, kink - Eigen::Vector3d(4, 3, 0), "floor");
  // 0.3 %: other patches and other rays; 1024 rays an element agree that well with themselves.
  EXPECT_NEAR(CeilingLx(junctions), clean, 0.003 * clean);
  EXPECT_NEAR(CeilingLx(slivers), clean, 0.003 * clean);
}

}  // namespace
}  // namespace luxfit
