#include "forward/direct/internal/luminaire_sight.h"

#include <gtest/gtest.h>

#include <random>

#include "forward/direct/direct_light.h"
#include "forward/light/room.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

Scene FurnishedRoom() {
  Scene scene = support::ClosedRoom({4, 3, 2.5});
  support::AddBox(scene, {Eigen::Vector3d(1.2, 0.8, 0.7), Eigen::Vector3d(2.8, 1.6, 0.75)},
                  support::Facing::kOutward, {"desk"});
  support::AddBox(scene, {Eigen::Vector3d(3.2, 0, 0), Eigen::Vector3d(3.6, 1.2, 1.9)},
                  support::Facing::kOutward, {"cabinet"});
  return scene;
}

Luminaire AnyLuminaire(std::mt19937_64& rng) {
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr LuminaireShape kShapes[] = {LuminaireShape::kPoint, LuminaireShape::kSphere,
                                        LuminaireShape::kDisc, LuminaireShape::kRectangle};
  Luminaire lamp;
  lamp.shape = kShapes[rng() % 4];
  lamp.position = {0.3 + 3.4 * unit(rng), 0.3 + 2.4 * unit(rng), 0.9 + 1.5 * unit(rng)};
  lamp.aim = Eigen::Vector3d(unit(rng) - 0.5, unit(rng) - 0.5, -unit(rng)).normalized();
  lamp.size_m = {0.1 + 0.5 * unit(rng), 0.1 + 0.5 * unit(rng)};
  return lamp;
}

// The definition: every ray cast for itself, no shaft asked.
float ShareByRays(const Room& room, const Element& element, const Luminaire& lamp, int order) {
  const std::vector<Eigen::Vector3d> probes = ShadowProbesOf(element, room.patches.IsTriangle(element.patch));
  double sum = 0;
  for (const Eigen::Vector3d& p : probes)
    sum += VisibleFraction(room.rays, lamp, p, element.normal, order) / static_cast<double>(probes.size());
  return static_cast<float>(sum);
}

TEST(ShadowProbesOf, AreCentresOfLikeParts) {
  Element element;
  element.origin = {1, 2, 0};
  element.edge_u = {0.4, 0, 0};
  element.edge_v = {0.1, 0.3, 0};
  for (const bool triangle : {false, true}) {
    const std::vector<Eigen::Vector3d> probes = ShadowProbesOf(element, triangle);
    ASSERT_EQ(probes.size(), 16U);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : probes) mean += p / 16;
    const Eigen::Vector3d centroid = element.origin + (element.edge_u + element.edge_v) / (triangle ? 3 : 2);
    EXPECT_LT((mean - centroid).norm(), 1e-12);
  }
}

TEST(ElementVisibility, IsThatOfTheRays) {
  const Room room = MakeRoom(FurnishedRoom(), {{0.5, 0.125}, {16}});
  std::vector<int> all(room.patches.elements.size());
  for (size_t e = 0; e < all.size(); ++e) all[e] = static_cast<int>(e);
  std::mt19937_64 rng(5);
  int partial = 0, hidden = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Luminaire lamp = AnyLuminaire(rng);
    const Eigen::MatrixXf share = ElementVisibility(room.rays, room.patches, all, {lamp}, 2);
    int differ = 0;
    for (const int e : all) {
      const float expected = ShareByRays(room, room.patches.elements[static_cast<size_t>(e)], lamp, 2);
      differ += std::abs(share(e, 0) - expected) > 1e-5F ? 1 : 0;
      partial += expected > 0 && expected < 1 ? 1 : 0;
      hidden += expected == 0 ? 1 : 0;
    }
    // Rays that graze an edge fall to either side in single precision.
    EXPECT_LE(differ, 2) << "trial " << trial;
  }
  EXPECT_GT(partial, 100);
  EXPECT_GT(hidden, 1000);
}

TEST(PatchSightOf, NeverContradictsARay) {
  const Room room = MakeRoom(FurnishedRoom(), {{0.5, 0.25}, {16}});
  const std::vector<Blocker> blockers = BlockersOf(room.patches.facets);
  std::mt19937_64 rng(6);
  int decided = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Luminaire lamp = AnyLuminaire(rng);
    for (const Element& element : room.patches.elements) {
      const Sight sight = PatchSightOf(room.patches, element.patch, lamp, blockers);
      if (sight == Sight::kPartial) continue;
      ++decided;
      const double share = VisibleFraction(room.rays, lamp, element.center, element.normal, 3);
      // The lamp may lie behind some points of a patch that sees it otherwise freely.
      const bool faces = element.normal.dot(lamp.position - element.center) > 0.5;
      if (sight == Sight::kNone) {
        EXPECT_EQ(share, 0) << trial;
      }
      if (sight == Sight::kFree && faces) {
        EXPECT_NEAR(share, 1, 1e-6) << trial;
      }
    }
  }
  EXPECT_GT(decided, 10000);
}

}  // namespace
}  // namespace luxfit
