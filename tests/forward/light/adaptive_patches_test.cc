#include "forward/light/internal/adaptive_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "forward/light/illuminance.h"
#include "forward/light/light_tracer.h"
#include "forward/light/room.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// A room with a partition that throws a shadow over the floor, lit from near the ceiling.
Scene RoomWithPartition() {
  Scene scene = support::ClosedRoom({5, 3, 2.7});
  support::AddBox(scene, {Eigen::Vector3d(2.95, 0, 0), Eigen::Vector3d(3.05, 2.2, 2)},
                  support::Facing::kOutward, {"partition"});
  return scene;
}

std::vector<Luminaire> Panel() {
  Luminaire panel;
  panel.position = {1.5, 1.5, 2.6};
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = {0.6, 0.6};
  panel.flux_lm = 3500;
  return {panel};
}

const Eigen::Vector2d kAlbedo(0.6, 0.4);

// From the light of patches of 0.8 m.
PatchesOptions Adaptive(const Scene& scene, double error_percent) {
  const Room coarse = MakeRoom(scene, {{0.8, 0.2}, {64}});
  const Receivers receivers = MakeReceivers(coarse, {}, {});
  const ColourIlluminance light =
      ComputeColourIlluminance(coarse, receivers, ComputeVisibility(coarse, receivers, Panel()), Panel(),
                               kAlbedo.transpose().replicate(3, 1), Eigen::Vector3d::Ones());
  const Eigen::VectorXf indirect_lx = 3500 * light.element_indirect.col(0);
  return AdaptivePatches(coarse, indirect_lx, Panel(), error_percent, {0.8, 0.1});
}

Patches Subdivided(const Scene& scene, double error_percent) {
  return Subdivide(scene, RayScene(scene), Adaptive(scene, error_percent));
}

TEST(AdaptivePatches, AreSmallWhereLightVaries) {
  const Scene scene = RoomWithPartition();
  const Patches patches = Subdivided(scene, 1);
  // Mean size by the floor's side under the panel, and low on the far wall, where no direct light reaches.
  double near_panel = 0, far = 0;
  int near_count = 0, far_count = 0;
  for (const Patch& patch : patches.patches) {
    const bool is_floor = patch.facet == 4, is_far_wall = patch.facet == 1;
    if (is_floor && patch.center.x() < 2.6) {
      near_panel += patch.area_m2;
      ++near_count;
    }
    if (is_far_wall && patch.center.y() < 2 && patch.center.z() < 0.6) {
      far += patch.area_m2;
      ++far_count;
    }
  }
  EXPECT_LT(near_panel / near_count, 0.5 * far / far_count);
}

TEST(AdaptivePatches, AreMoreForASmallerBound) {
  const Scene scene = RoomWithPartition();
  const size_t coarse = Subdivided(scene, 8).patches.size(), middle = Subdivided(scene, 2).patches.size(),
               fine = Subdivided(scene, 0.5).patches.size();
  EXPECT_LT(coarse, middle);
  EXPECT_LT(middle, fine);
  EXPECT_THROW(Subdivided(scene, 0), std::invalid_argument);
  EXPECT_THROW(AdaptivePatches(MakeRoom(scene, {{0.8, 0.4}, {16}}), Eigen::VectorXf::Zero(3), Panel(), 1),
               std::invalid_argument);
}

TEST(AdaptivePatches, NeverSpanWhatStandsOnThem) {
  const Scene scene = RoomWithPartition();
  const RayScene rays(scene);
  for (const Patch& patch : Subdivide(scene, rays, {0.8, 0.1}).patches) {
    const double low = std::min(patch.origin.x(), patch.origin.x() + patch.edge_u.x() + patch.edge_v.x());
    const double high = std::max(patch.origin.x(), patch.origin.x() + patch.edge_u.x() + patch.edge_v.x());
    const bool spans = patch.facet == 4 && low < 2.95 && high > 3.05 && patch.origin.y() < 2.1 &&
                       patch.origin.y() + patch.edge_u.y() + patch.edge_v.y() < 2.2;
    EXPECT_FALSE(spans) << patch.center.transpose();
  }
}

// The light that reaches the shade behind the partition, against paths that know no patches.
TEST(AdaptivePatches, GiveTheLightTracersIlluminance) {
  const Scene scene = RoomWithPartition();
  const std::vector<Luminaire> panel = Panel();
  const std::vector<Sensor> sensors = {
      {{4, 0.5, 0.01}, {0, 0, 1}, {}}, {{4, 1.5, 0.8}, {0, 0, 1}, {}}, {{1.5, 0.5, 0.01}, {0, 0, 1}, {}}};
  const RayScene rays(scene);
  LightTracerOptions paths;
  paths.paths_per_sensor *= 4;  // the first sensor sees little of what is lit
  const TracedIlluminance traced = TraceIlluminance(scene, rays, panel, kAlbedo, sensors, paths);
  RoomOptions options;
  options.patches = Adaptive(scene, 1);
  const Room room = MakeRoom(scene, options);
  const Receivers receivers = MakeReceivers(room, {}, sensors);
  const Illuminance solved =
      ComputeIlluminance(room, receivers, ComputeVisibility(room, receivers, panel), panel, kAlbedo);
  for (Eigen::Index s = 0; s < 3; ++s) {
    const double expected = traced.direct(s, 0) + traced.indirect(s, 0);
    const double sigma = std::hypot(traced.direct_sigma(s, 0), traced.indirect_sigma(s, 0));
    EXPECT_NEAR(3500 * solved.total(s, 0), expected, 4 * sigma + 0.01 * expected) << s;  // the bound
    // Half of the 1 % that the patches may cost, or the paths would not tell.
    std::printf("sensor %d: the tracer's sigma is %.2f %%\n", static_cast<int>(s), 100 * sigma / expected);
    EXPECT_LT(sigma, 0.005 * expected) << s << ": too noisy for the test to tell";
  }
}

}  // namespace
}  // namespace luxfit
